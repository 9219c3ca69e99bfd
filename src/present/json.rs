//! Results as JSON: every document begins with program, version and units. A number that is not finite is `null`.

use super::PresentError;
use super::deck::{not_read, unit_shapes};
use crate::files::deck::Unread;
use crate::files::test_data::DIRECTIONS;
use crate::files::turns;
use crate::job::of_bodies;
use crate::method::structure::StructuralDof;
use crate::sparse::whole_modes::WholeModes;
use nalgebra::RowDVector;
use serde::Serialize;
use serde_json::{Value, json};

/// A document with its heading.
#[derive(Serialize)]
struct Document<T> {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    #[serde(flatten)]
    content: T,
}

/// Units of a user's structure.
pub const OWN_UNITS: &str = "the model's own units, hertz; errors are fractions";
/// Units of the paper's structure.
pub const BOX_UNITS: &str = "inch, pound-force, second, hertz; errors are fractions";

/// A document in these units with its heading as pretty-printed JSON and a final newline.
///
/// # Errors
/// [`PresentError::Json`], which memory alone could cause.
pub fn document(units: &'static str, content: impl Serialize) -> Result<String, PresentError> {
    let document = Document {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        units,
        content,
    };
    Ok(unturned(&serde_json::to_string_pretty(&document)?) + "\n")
}

/// JSON in which characters that turn the direction of text are escaped.
pub(super) fn unturned(json: &str) -> String {
    let mut text = String::new();
    for c in json.chars() {
        match turns(c) {
            true => text += &format!("\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    text
}

/// The lowest `count` modes of a deck or of matrices, every shape scaled to a largest component of one; components in the order of
/// `dof`, which is empty for matrices that do not name their rows. `moving` has them in the same scale at all that moves in a deck.
pub fn deck_modes(
    unread: &[Unread],
    modes: &WholeModes,
    moving: &[(StructuralDof, RowDVector<f64>)],
    count: usize,
) -> Result<String, PresentError> {
    let (masses, shapes) = unit_shapes(modes, count);
    let named =
        |dof: &StructuralDof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]});
    let at = |mode: usize, mass: &f64| {
        let components = moving.iter().map(|(_, shape)| shape[mode] * mass.sqrt());
        components.collect::<Value>()
    };
    document(
        OWN_UNITS,
        json!({
            "dof": modes.dof.iter().map(named).collect::<Value>(),
            "moving_dof": moving.iter().map(|(dof, _)| named(dof)).collect::<Value>(),
            "moving_shapes": masses.iter().enumerate().map(|(mode, mass)| at(mode, mass)).collect::<Value>(),
            "rigid_body_modes": modes.rigid_body,
            "doubtful": modes.doubtful.iter().map(|found| of_bodies(found).words).collect::<Vec<_>>(),
            "frequencies_hz": modes.modes.frequencies_hz().into_iter().take(count).collect::<Value>(),
            "generalized_masses": masses,
            "shapes": shapes,
            "not_read": unread.iter().map(not_read).collect::<Value>(),
        }),
    )
}
