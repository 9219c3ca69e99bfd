//! A guided tour of the method: twelve chapters of eleven to twenty minutes, in which every number is computed where it stands.
//!
//! Every chapter has its derivation, code that runs, one figure and one exercise with its answer. `cargo test --doc tour` compiles and
//! runs all of it. Read in order: each chapter needs those before it, and no other book. The last can be read at any time.
//!
//! 1. [Two springs by hand](chapter_01_two_springs)
//! 2. [From one row to the recursion](chapter_02_recursion)
//! 3. [Which mode is which, and how far apart](chapter_03_error_sum)
//! 4. [The step](chapter_04_step)
//! 5. [One sentence, four readings](chapter_05_readings)
//! 6. [The inner loop](chapter_06_inner_loop)
//! 7. [Condensation, and two bounds](chapter_07_condensation)
//! 8. [The box and Cases 1 to 3](chapter_08_box)
//! 9. [Case 4: finding a mistake](chapter_09_mistake)
//! 10. [Noise, and what cannot be seen](chapter_10_noise)
//! 11. [Your own structure](chapter_11_own_structure)
//! 12. [Three elements](chapter_12_elements)

pub mod chapter_01_two_springs {
    #![doc = include_str!("../paper/tour/01_two_springs.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/springs.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_01.svg")]
}

pub mod chapter_02_recursion {
    #![doc = include_str!("../paper/tour/02_recursion.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_02.svg")]
}

pub mod chapter_03_error_sum {
    #![doc = include_str!("../paper/tour/03_error_sum.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_03.svg")]
}

pub mod chapter_04_step {
    #![doc = include_str!("../paper/tour/04_step.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_04.svg")]
}

pub mod chapter_05_readings {
    #![doc = include_str!("../paper/tour/05_readings.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/counted_gages.svg")]
}

#[allow(rustdoc::invalid_html_tags)]
pub mod chapter_06_inner_loop {
    #![doc = include_str!("../paper/tour/06_inner_loop.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_06.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/presentation/page/play.html")]
    #![doc = "<script>"]
    #![doc = include_str!("../paper/tour/06_play.js")]
    #![doc = include_str!("../paper/presentation/page/play.js")]
    #![doc = "</script>"]
}

pub mod chapter_07_condensation {
    #![doc = include_str!("../paper/tour/07_condensation.md")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/box_points.svg")]
}

pub mod chapter_08_box {
    #![doc = include_str!("../paper/tour/08_box.md")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/box_points.svg")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/case_1_mode_shapes.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_08.svg")]
}

pub mod chapter_09_mistake {
    #![doc = include_str!("../paper/tour/09_mistake.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_09.svg")]
}

pub mod chapter_10_noise {
    #![doc = include_str!("../paper/tour/10_noise.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_10.svg")]
}

pub mod chapter_11_own_structure {
    #![doc = include_str!("../paper/tour/11_own_structure.md")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/box_elements.svg")]
}

pub mod chapter_12_elements {
    #![doc = include_str!("../paper/tour/12_elements.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/elements.svg")]
}
