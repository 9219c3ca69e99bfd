//! The stored answers of NASTRAN-95 (`golden/nastran95/README.md`), read as they are.

use crate::prelude::*;

/// One element with its stiffness.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredElement {
    pub name: String,
    pub kind: String,
    #[serde(rename = "note")]
    _note: String,
    #[serde(default)]
    pub snap: bool,
    pub tolerance: Option<f64>,
    youngs_modulus: f64,
    poissons_ratio: f64,
    area: Option<f64>,
    thickness: Option<f64>,
    grids: Vec<[f64; 3]>,
    stiffness: Vec<Vec<f64>>,
}

impl StoredElement {
    pub fn corners(&self) -> Vec<Vector3<f64>> {
        self.grids.iter().map(|&grid| grid.into()).collect()
    }

    pub fn material(&self) -> Material {
        Material::isotropic(self.youngs_modulus, self.poissons_ratio).unwrap()
    }

    /// Its stiffness as this crate has it.
    pub fn computed(&self) -> DMatrix<f64> {
        let (corners, material) = (self.corners(), self.material());
        let kind = match self.kind.as_str() {
            "rod" => ElementKind::Rod,
            "shear" => ElementKind::ShearPanel,
            "membrane" => ElementKind::Membrane,
            "triangle" => ElementKind::Triangle,
            other => panic!("{}: unknown kind {other}", self.name),
        };
        self.area.or(self.thickness).unwrap() * unit_stiffness(kind, &corners, &material)
    }

    /// Its stiffness as NASTRAN-95 has it.
    pub fn stored(&self) -> DMatrix<f64> {
        let rows = self.stiffness.iter().flatten().copied().collect_vec();
        DMatrix::from_row_slice(self.stiffness.len(), self.stiffness.len(), &rows)
    }
}

/// One torque box with its stiffness and, if it is no mechanism, its eigenvalues.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredBox {
    pub name: String,
    #[serde(rename = "note")]
    _note: String,
    youngs_modulus: f64,
    poissons_ratio: f64,
    rod_area: f64,
    membranes: Vec<usize>,
    omitted: Vec<usize>,
    pub snapped: Vec<usize>,
    gages: Vec<f64>,
    grids: Vec<[f64; 3]>,
    pub eigenvalues: Option<Vec<f64>>,
    pub known_eigenvalues: Option<Vec<f64>>,
    pub printed_eigenvalues: Option<Vec<f64>>,
    kaa_lower: Vec<Vec<f64>>,
}

/// All boxes and what they share.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredBoxes {
    #[serde(rename = "program")]
    _program: String,
    fixed_grids: Vec<usize>,
    /// On z of each free grid, lbf·s²/in.
    pub mass: f64,
    panels: Vec<[usize; 4]>,
    pub rods: Vec<[usize; 2]>,
    #[serde(rename = "box")]
    pub boxes: Vec<StoredBox>,
}

impl StoredBoxes {
    /// A box as a structure of this crate: the panels that are not omitted, by their numbers, then rods 16 to 39.
    pub fn structure(&self, stored: &StoredBox) -> Structure {
        let material = Material::isotropic(stored.youngs_modulus, stored.poissons_ratio).unwrap();
        let grids = stored.grids.iter().zip(1..).map(|(&position, label)| Grid {
            label,
            position: position.into(),
            constrained: [self.fixed_grids.contains(&label); 3],
        });
        let panels = self.panels.iter().zip(1..).map(|(grids, label)| Element {
            label,
            kind: if stored.membranes.contains(&label) {
                ElementKind::Membrane
            } else {
                ElementKind::ShearPanel
            },
            grids: grids.to_vec(),
            size: stored.gages[label - 1],
            material,
        });
        let rods = self.rods.iter().zip(16..).map(|(grids, label)| Element {
            label,
            kind: ElementKind::Rod,
            grids: grids.to_vec(),
            size: stored.rod_area,
            material,
        });
        let elements = panels
            .filter(|panel| !stored.omitted.contains(&panel.label))
            .chain(rods);
        Structure::new(grids.collect(), elements.collect()).unwrap()
    }
}

impl StoredBox {
    /// Stiffness at the 36 free DOF as NASTRAN-95 has it.
    pub fn stored(&self) -> DMatrix<f64> {
        let count = self.kaa_lower.len();
        DMatrix::from_fn(count, count, |a, b| self.kaa_lower[a.max(b)][a.min(b)])
    }
}

pub fn elements() -> Vec<StoredElement> {
    #[derive(Deserialize)]
    struct File {
        element: Vec<StoredElement>,
    }
    let text = include_str!("../../golden/nastran95/elements.toml");
    toml::from_str::<File>(text).unwrap().element
}

pub fn boxes() -> StoredBoxes {
    toml::from_str(include_str!("../../golden/nastran95/boxes.toml")).unwrap()
}

/// The factor NASTRAN-95 puts on a shear panel's stiffness: its own energy, with sides taken for parallel when the
/// tangent of the angle between them is below 0.01, under the true one.
pub fn snap_factor(corners: &[Vector3<f64>], material: &Material) -> f64 {
    let flat = mean_plane(corners);
    let [_, c2, c3, c4] = flat;
    let tangent = 0.01;
    let parallel_12_34 = (c3.y - c4.y).abs() < tangent * (c3.x - c4.x).abs();
    let parallel_14_23 = (c4.y * (c3.x - c2.x) - c3.y * c4.x).abs()
        < tangent * (c4.x * (c3.x - c2.x) + c4.y * c3.y).abs();
    let energy = match (parallel_12_34, parallel_14_23) {
        (true, true) => parallelogram_energy,
        (true, false) => sides_12_34_parallel_energy,
        (false, true) => sides_14_23_parallel_energy,
        (false, false) => no_sides_parallel_energy,
    };
    energy_coefficient(corners, material) / energy(&flat, material)
}
