//! Mistakes made on purpose.

use super::specimen::Specimen;
use crate::common::alter;
use corfem::job::preflight::{Change, FACTORS, Finding, Mended};
use corfem::method::error::Error;
use corfem::sparse::random::split_mix_64;
use corfem::weighted::noise::{Noise, with_noise};
use nalgebra::DMatrix;

/// A mistake made on purpose; what it hits is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mistake {
    /// Frequencies times one of [`FACTORS`], in turn.
    Factor,
    /// One sensor reversed.
    Reversed,
    /// Two sensors exchanged.
    Exchanged,
    /// The test's points in any other order.
    Reordered,
    /// Two columns of $T$ exchanged.
    TwoColumns,
    /// The columns of $T$ in any other order.
    Columns,
    /// The shape matrix transposed.
    Transposed,
    /// Frequencies of two modes exchanged.
    Frequencies,
    /// One mode given again in place of another, with noise of its own.
    Repeated,
    /// One point fewer than modes.
    FewPoints,
}

/// All mistakes.
pub const MISTAKES: [Mistake; 10] = {
    use Mistake::*;
    [
        Factor,
        Reversed,
        Exchanged,
        Reordered,
        TwoColumns,
        Columns,
        Transposed,
        Frequencies,
        Repeated,
        FewPoints,
    ]
};

/// Numbers below a bound, from a seed.
struct Draw(u64);

impl Draw {
    fn below(&mut self, bound: usize) -> usize {
        (split_mix_64(&mut self.0) % bound.max(1) as u64) as usize
    }

    /// Two different numbers in ascending order, of at least two.
    fn two(&mut self, bound: usize) -> [usize; 2] {
        let (a, b) = (self.below(bound), self.below(bound - 1));
        let b = if b < a { b } else { b + 1 };
        [a.min(b), a.max(b)]
    }

    fn order(&mut self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        (1..count)
            .rev()
            .for_each(|last| order.swap(last, self.below(last + 1)));
        order
    }
}

/// How well a finding names a mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Naming {
    /// Not.
    Not,
    /// As the next best.
    Next,
    /// First.
    First,
}

/// Model and test with a mistake, and how well a finding names it.
pub(super) type Planted = (Specimen, Box<dyn Fn(&Finding) -> Naming>);

fn names(change: Change) -> Box<dyn Fn(&Finding) -> Naming> {
    Box::new(move |finding| match finding {
        Finding::Mended(mended) if mended.change == change => Naming::First,
        Finding::Mended(Mended {
            next: Some((next, _)),
            ..
        }) if *next == change => Naming::Next,
        _ => Naming::Not,
    })
}

fn either(named: bool) -> Naming {
    if named { Naming::First } else { Naming::Not }
}

/// Whether the masses are made with the columns of $T$, and so take their order: those of elements, which it spreads over several
/// points. Masses given at the points are diagonal.
pub fn mass_follows(specimen: &Specimen) -> bool {
    let mass = &specimen.model.mass;
    *mass != DMatrix::from_diagonal(&mass.diagonal())
}

/// A symmetric matrix with rows and columns in another order.
fn reordered(matrix: &DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(order).select_columns(order)
}

/// The order that undoes another.
fn inverse(order: &[usize]) -> Vec<usize> {
    let mut places: Vec<usize> = (0..order.len()).collect();
    places.sort_by_key(|&place| order[place]);
    places
}

/// A structure whose test has noise, with a mistake; none where the structure does not allow it.
pub(super) fn plant(
    right: &Specimen,
    mistake: Mistake,
    seed: u64,
) -> Result<Option<Planted>, Error> {
    let mut specimen = Specimen {
        test: with_noise(&right.test, Noise::USUAL, seed)?,
        ..right.clone()
    };
    let (points, modes) = specimen.test.shapes().shape();
    let mut draw = Draw(seed);
    let mut moved = specimen.test.shapes().clone();
    let shapes = &mut moved;
    let named: Box<dyn Fn(&Finding) -> Naming> = match mistake {
        Mistake::Factor => {
            let known = FACTORS[seed as usize % FACTORS.len()];
            alter(&mut specimen.test, |squares, _| {
                *squares *= known.factor.powi(2)
            });
            Box::new(move |finding| {
                either(
                    matches!(finding, Finding::CommonFactor(found) if found.named == Some(known)),
                )
            })
        }
        Mistake::Reversed => {
            let sensor = draw.below(points);
            shapes.row_mut(sensor).neg_mut();
            names(Change::Reversed(sensor))
        }
        Mistake::Exchanged => {
            let sensors = draw.two(points);
            shapes.swap_rows(sensors[0], sensors[1]);
            names(Change::Exchanged(sensors))
        }
        Mistake::Reordered => {
            let order = draw.order(points);
            *shapes = shapes.select_rows(&order);
            names(Change::Reordered(inverse(&order)))
        }
        Mistake::TwoColumns | Mistake::Columns => {
            let two = draw.two(points);
            let mut order: Vec<usize> = (0..points).collect();
            match mistake {
                Mistake::Columns => order = draw.order(points),
                _ => order.swap(two[0], two[1]),
            }
            specimen.model.stiffness = reordered(&specimen.model.stiffness, &order);
            if !mass_follows(right) {
                names(Change::Columns(inverse(&order)))
            } else {
                specimen.model.mass = reordered(&specimen.model.mass, &order);
                names(if mistake == Mistake::Columns {
                    Change::Reordered(order)
                } else {
                    Change::Exchanged(two)
                })
            }
        }
        Mistake::Transposed if points == modes => {
            shapes.transpose_mut();
            names(Change::Transposed)
        }
        Mistake::Transposed => return Ok(None),
        Mistake::Frequencies => {
            let two = draw.two(modes);
            alter(&mut specimen.test, |squares, _| {
                squares.swap_rows(two[0], two[1])
            });
            Box::new(move |finding| {
                either(
                    matches!(finding, Finding::FrequenciesExchanged(found) if found.modes == two),
                )
            })
        }
        Mistake::Repeated => {
            let two = draw.two(modes);
            // Noise of its own: that of another seed.
            let again = with_noise(&right.test, Noise::USUAL, seed + 1_000_000)?;
            shapes.set_column(two[1], &again.shapes().column(two[0]));
            alter(&mut specimen.test, |squares, _| {
                squares[two[1]] = again.omega_squared()[two[0]];
            });
            Box::new(move |finding| {
                either(matches!(finding, Finding::NearlySame { modes, .. } if *modes == two))
            })
        }
        Mistake::FewPoints => {
            let mut kept = draw.order(points);
            kept.truncate(modes - 1);
            *shapes = shapes.select_rows(&kept);
            // The others held, so that both matrices stay positive.
            specimen.model.stiffness = reordered(&specimen.model.stiffness, &kept);
            specimen.model.mass = reordered(&specimen.model.mass, &kept);
            Box::new(|finding| either(matches!(finding, Finding::TooManyModes { .. })))
        }
    };
    specimen.test = specimen.test.with_shapes(moved)?;
    Ok(Some((specimen, named)))
}
