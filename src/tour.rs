//! A guided tour of the method: ten chapters, ten minutes each, in which every number is computed where it stands.
//!
//! Every chapter has its derivation, code that runs, one figure and one exercise with its answer. `cargo test --doc tour` compiles and
//! runs all of it. Read in order; each chapter needs those before it and no other book.
//!
//! 1. [Two springs by hand](chapter_01_two_springs)
//! 2. [From one row to the recursion](chapter_02_recursion)
//! 3. [Which mode is which, and how far apart](chapter_03_error_sum)
//! 4. [The step](chapter_04_step)
//! 5. [The inner loop](chapter_05_inner_loop)
//! 6. [Condensation, and two bounds](chapter_06_condensation)
//! 7. [The box and Cases 1 to 3](chapter_07_box)
//! 8. [Case 4: finding a mistake](chapter_08_mistake)
//! 9. [Noise, and what cannot be seen](chapter_09_noise)
//! 10. [Your own structure](chapter_10_own_structure)

pub mod chapter_01_two_springs {
    #![doc = include_str!("../paper/tour/01_two_springs.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/springs.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_01.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_01_narrow.svg")]
}

pub mod chapter_02_recursion {
    #![doc = include_str!("../paper/tour/02_recursion.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_02.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_02_narrow.svg")]
}

pub mod chapter_03_error_sum {
    #![doc = include_str!("../paper/tour/03_error_sum.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_03.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_03_narrow.svg")]
}

pub mod chapter_04_step {
    #![doc = include_str!("../paper/tour/04_step.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_04.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_04_narrow.svg")]
}

pub mod chapter_05_inner_loop {
    #![allow(rustdoc::invalid_html_tags, reason = "the figure's script writes tags")]
    #![doc = include_str!("../paper/tour/05_inner_loop.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_05.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_05_narrow.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/tour/05_play.html")]
}

pub mod chapter_06_condensation {
    #![doc = include_str!("../paper/tour/06_condensation.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_06.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_06_narrow.svg")]
}

pub mod chapter_07_box {
    #![doc = include_str!("../paper/tour/07_box.md")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/box_points.svg")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/box_points_narrow.svg")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/case_1_mode_shapes.svg")]
    #![doc = ""]
    #![doc = include_str!("../golden/figures/case_1_mode_shapes_narrow.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_07.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_07_narrow.svg")]
}

pub mod chapter_08_mistake {
    #![doc = include_str!("../paper/tour/08_mistake.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_08.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_08_narrow.svg")]
}

pub mod chapter_09_noise {
    #![doc = include_str!("../paper/tour/09_noise.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_09.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_09_narrow.svg")]
}

pub mod chapter_10_own_structure {
    #![doc = include_str!("../paper/tour/10_own_structure.md")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_10.svg")]
    #![doc = ""]
    #![doc = include_str!("../paper/figures/tour_10_narrow.svg")]
}
