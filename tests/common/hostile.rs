//! Matrices, modes and models that nobody means: of any size, of extreme numbers, of what is no number.

use crate::prelude::*;

/// Numbers that break things: zeros, ends of the range, and what is no number.
const NASTY: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.0,
    0.5,
    1e-9,
    1e9,
    1e160,
    1e-160,
    1e300,
    1e-300,
    -1e300,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// Matrices, sizes and DOF of elements.
type Elements = (Vec<ElementMatrix>, Vec<f64>, Vec<StructuralDof>);

impl Draws {
    /// Half of all numbers are ordinary ones, so that calls come past the first check.
    pub fn number(&mut self) -> f64 {
        if self.below(2) == 0 {
            NASTY[self.below(NASTY.len())]
        } else {
            self.below(2000) as f64 / 100.0 - 8.0
        }
    }

    /// Sizes from none to four.
    pub fn size(&mut self) -> usize {
        self.below(5)
    }

    pub fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    pub fn vector(&mut self, count: usize) -> DVector<f64> {
        DVector::from_vec(self.list(count))
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_vec(rows, columns, self.list(rows * columns))
    }

    /// Of the size wanted, or now and then of another.
    pub fn about(&mut self, size: usize) -> usize {
        if self.below(8) == 0 {
            self.size()
        } else {
            size
        }
    }

    /// Bounds in any order.
    pub fn bounds(&mut self) -> Bounds {
        let (lower, upper) = (self.number(), self.number());
        Bounds { lower, upper }
    }

    /// A matrix that is meant to be symmetric: often it is, often definite, and scaled by anything.
    pub fn symmetric(&mut self, size: usize) -> DMatrix<f64> {
        let (rows, columns) = (self.about(size), self.about(size));
        let matrix = self.matrix(rows, columns);
        match self.below(4) {
            0 => matrix,
            1 if rows == columns => &matrix + matrix.transpose(),
            _ if rows == columns => {
                let tame = matrix.map(|entry| if entry.abs() < 1e3 { entry } else { 1.0 });
                let scale = [1.0, 1.0, 1e160, 1e-160, 1e300, 1e-300][self.below(6)];
                (&tame * tame.transpose() + eye(rows)) * scale
            }
            _ => matrix,
        }
    }

    pub fn modes(&mut self, dof: usize) -> Result<Modes, Error> {
        let (rows, count) = (self.about(dof), self.size());
        let length = self.about(count);
        Modes::new(self.vector(length), self.matrix(rows, count))
    }

    pub fn corners(&mut self) -> [Vector3<f64>; 4] {
        let flat = self.below(2) == 0;
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        square.map(|[x, y]| {
            let moved = if self.below(4) == 0 {
                self.number()
            } else {
                0.0
            };
            Vector3::new(
                10.0 * x + moved,
                7.0 * y,
                if flat { 0.0 } else { self.number() },
            )
        })
    }

    pub fn material(&mut self) -> Material {
        let mut metal = Material::isotropic(1e7, 0.3).unwrap();
        if self.below(2) == 0 {
            (metal.youngs_modulus, metal.poissons_ratio) = (self.number(), self.number());
            (metal.shear_modulus, metal.density) = (self.number(), self.number());
        }
        metal
    }

    /// Any model, or now and then one that is right.
    pub fn dynamic(&mut self) -> DynamicModel {
        let size = self.size();
        let matrix: fn(&mut Self, usize) -> DMatrix<f64> = match self.below(4) {
            0 => |_, size| eye(size),
            _ => Self::symmetric,
        };
        let (stiffness, mass) = (matrix(self, size), matrix(self, size));
        let shares = (0..self.below(4)).map(|_| matrix(self, size)).collect();
        DynamicModel {
            stiffness,
            mass,
            shares,
        }
    }

    /// A spring chain and its modal model: what comes out of a constructor, for the loops to be given bad settings and factors.
    pub fn chain(&mut self) -> Option<ModalModel> {
        let count = 1 + self.below(4);
        let share = |spring: usize| spring_stiffness(count, spring, 100.0);
        let shares = (0..count).map(share).collect_vec();
        let stiffness = shares.iter().sum::<DMatrix<f64>>();
        let mass = eye(count);
        let test = solve(&(1.2 * &stiffness), &mass, count).ok()?;
        DynamicModel {
            stiffness,
            mass,
            shares,
        }
        .analyze(&test, None)
        .ok()
    }

    /// A change of stiffness and mass that fits together or does not.
    pub fn change(&mut self) -> ModalChange {
        let size = self.size();
        let (alpha, beta, length) = (self.symmetric(size), self.symmetric(size), self.about(size));
        ModalChange::of_vibrations(&self.vector(length), beta, alpha)
    }

    /// A pairing of so many test modes with analysis modes, or of others.
    pub fn pairing(&mut self, test: usize, analysis: usize) -> Result<Pairing, Error> {
        let (modes, signs) = (self.about(test), self.about(test));
        let outside = self.below(8) / 7;
        let analysis_mode = (0..modes).map(|_| self.below(analysis + outside)).collect();
        let sign = (0..signs).map(|_| [-1.0, 1.0][self.below(2)]).collect();
        Ok(Pairing {
            analysis_mode,
            sign,
        })
    }

    /// Analysis modes, test modes and what pairs them.
    pub fn compared(&mut self) -> Result<(Modes, Pairing, Modes), Error> {
        let size = self.size();
        let (analysis, test) = (self.modes(size)?, self.modes(size)?);
        let pairing = self.pairing(test.len(), analysis.len())?;
        Ok((analysis, pairing, test))
    }

    /// Errors of any number of modes, none included.
    pub fn errors(&mut self) -> Errors {
        Errors {
            frequency: self.unit(),
            shape: self.unit(),
            frequency_count: self.size(),
            shape_count: self.size(),
        }
    }

    /// A state of a model, or of another.
    pub fn state(&mut self, model: &ModalModel) -> State {
        let other = self.chain().filter(|_| self.below(6) == 0);
        let model = other.as_ref().unwrap_or(model);
        let factors = if self.below(2) == 0 {
            vec![1.0; model.shares().len()]
        } else {
            vec![1.1; model.shares().len()]
        };
        model.at(&factors).unwrap_or_else(|_| model.exact().clone())
    }

    /// Four grids, two of them held, and rods and panels between them.
    pub fn structure(&mut self) -> Result<Structure, Error> {
        let held = [
            [true; 3],
            [true; 3],
            [false, false, true],
            [false, false, true],
        ];
        let place = |(row, position)| Grid {
            label: row + 1,
            position,
            constrained: held[row],
        };
        let mut grids = self
            .corners()
            .into_iter()
            .enumerate()
            .map(place)
            .collect_vec();
        if self.below(8) == 0 {
            grids[self.size() % 4].constrained = [self.below(2) == 0; 3];
        }
        let rods = [[1, 3], [2, 3], [2, 4], [1, 4], [3, 4]];
        let mut elements: Vec<Element> = Vec::new();
        for (row, ends) in rods.iter().enumerate() {
            let material = if self.below(8) == 0 {
                self.material()
            } else {
                Material::isotropic(1e7, 0.3)?
            };
            let size = if self.below(16) == 0 {
                self.number()
            } else {
                0.5
            };
            elements.push(Element {
                label: row + 1,
                kind: ElementKind::Rod,
                grids: ends.to_vec(),
                size,
                material,
            });
        }
        if self.below(2) == 0 {
            let panel = [ElementKind::Membrane, ElementKind::ShearPanel][self.below(2)];
            let material = Material {
                density: 3e-4,
                ..Material::isotropic(1e7, 0.3)?
            };
            elements.push(Element {
                label: 6,
                kind: panel,
                grids: vec![1, 2, 3, 4],
                size: 0.1,
                material,
            });
        }
        if self.below(16) == 0 {
            elements[self.size()].grids = vec![self.size(); self.size()];
        }
        Structure::new(grids, elements)
    }

    /// Element matrices, their sizes and the DOF they belong to, of which a part may not fit the others.
    pub fn elements(&mut self) -> Result<Elements, Error> {
        let structure = self.structure()?;
        let mut elements = element_matrices(&structure).collect_vec();
        let mut free = structure.free_dof().to_vec();
        let count = self.about(elements.len());
        let sizes = (0..count)
            .map(|_| {
                if self.below(16) == 0 {
                    self.number()
                } else {
                    0.5
                }
            })
            .collect();
        let (row, size) = (self.below(elements.len()), self.size());
        match self.below(12) {
            0 => elements[row].dof = vec![self.size(); size],
            1 => elements[row].unit = self.symmetric(size),
            3 => elements[row].unit *= self.number(),
            4 => free.truncate(size),
            5 => free.iter_mut().for_each(|dof| dof.direction += size),
            6 => elements.truncate(size),
            7 => elements[row]
                .dof
                .iter_mut()
                .for_each(|dof| *dof = usize::MAX - *dof),
            _ => {}
        }
        Ok((elements, sizes, free))
    }

    /// A selection of DOF, or any matrix.
    pub fn load_distribution(&mut self, free: usize) -> DMatrix<f64> {
        let (rows, columns) = (self.about(free), self.size());
        if self.below(4) == 0 {
            self.matrix(rows, columns)
        } else {
            DMatrix::identity(rows, columns.max(1))
        }
    }

    /// Parameters of every sort, with members and bounds that may not be.
    pub fn parameters(&mut self) -> Vec<Parameter> {
        let parameter = |draws: &mut Self, place: usize| {
            let member = if draws.below(6) == 0 {
                draws.below(8)
            } else {
                place + usize::from(place == 0)
            };
            let factor_range = (draws.below(3) == 0).then(|| Bounds {
                lower: draws.number(),
                upper: draws.number(),
            });
            Parameter {
                factor_range,
                ..Parameter::new("drawn", &[member])
            }
        };
        (0..1 + self.below(2))
            .map(|place| parameter(self, 2 * place))
            .collect()
    }

    /// A finite element model, and factors for its parameters or for others.
    pub fn finite_element(&mut self) -> Result<(FiniteElementModel, Vec<f64>), Error> {
        let structure = self.structure()?;
        let load_distribution = self.load_distribution(structure.free_dof().len());
        let points = load_distribution.ncols();
        let mass = if self.below(4) == 0 {
            self.symmetric(points)
        } else {
            0.01 * eye(points)
        };
        let parameters = self.parameters();
        let count = self.about(parameters.len());
        let factors = if self.below(2) == 0 {
            vec![1.1; count]
        } else {
            self.list(count)
        };
        Ok((
            FiniteElementModel::new(structure, load_distribution, mass, parameters)?,
            factors,
        ))
    }
}
