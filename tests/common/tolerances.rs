//! The one ledger of tolerances. Each line says why it is what it is; no test has a tolerance of its own.
//! Which two routes every number has is in `tests/routes.toml`.

/// A few roundings of numbers of order one.
pub const ROUND_OFF: f64 = 1e-13;
/// Sides of an equation on the crate's own answers, relative: (12) is a difference of a ten-thousandth of its terms, A.2 is solved with a
/// matrix of condition 1e4; both leave 1e-12.
pub const FORMULA: f64 = 1e-11;
/// Sides of a misprint: the least that one change of one place makes of the vectors' data, and far above [`FORMULA`].
pub const MISPRINT: f64 = 1e-6;
/// Answers of wrong equations, of the largest: six digits are stored, and one that is nearer to the known answer is none.
pub const WRONG_ANSWER: f64 = 1e-5;
/// Errors of a mode held out, in percent: steps end a thousandth of a deviation, a hundredth of a percent, from the optimum.
pub const HELD_OUT: f64 = 1e-3;
/// Places of trials and numbers of a set-up: a basis is left where a thousandth of the promised fall is left, three hundredths of its step; other
/// cases stand farther from the limit that they are set beside.
pub const SET_UP: f64 = 0.05;
/// Quantiles of chi-squared, which are sought to the root of the rounding of doubles and better.
pub const QUANTILE: f64 = 1e-9;
/// Ends of golden runs, in standard deviations of a factor: steps end within a hundred-thousandth of the optimum.
pub const RUN_DEVIATIONS: f64 = 1e-3;
/// Chi-squared of golden runs that end where it is not stationary, relative to the larger of it and one.
pub const RUN_OBJECTIVE: f64 = 1e-6;
/// What is round-off and nothing else: errors over nine modes whose roots span 4e4.
pub const ROUND_OFF_FLOOR: f64 = 1e-11;
/// A matrix product chain of a dozen DOF, relative to its largest entry.
pub const MATRIX_ROUND_OFF: f64 = 1e-11;
/// Round-off of a solution per unit of its matrix's condition number: some fifty roundings.
pub const CONDITIONED_ROUND_OFF: f64 = 1e-14;
/// A difference of a hundred-millionth of its terms, relative: what is left of sixteen digits, and some.
pub const DIFFERENCE_ROUND_OFF: f64 = 1e-6;
/// Part of the mean over all free motions above which a DOF takes part in them: the one that moves most in some of
/// them may have less than the mean over all, one that is held has nothing but round-off.
pub const TAKES_PART: f64 = 1e-2;
/// Eigenvalue over the largest of its matrix below which it is zero: element matrices leave 1e-15 where the theory has
/// zero, and the strategies' panels have nothing below 1e-3 where it has not.
pub const RANK_THRESHOLD: f64 = 1e-9;
/// Element matrices computed in two frames: coordinates 100 in from the origin carry 1e-13 of a panel's size, and
/// the strategies' distortion multiplies that by ten or so; relative to the largest entry.
pub const ELEMENT_ROUND_OFF: f64 = 1e-11;
/// Quadrature of a trapezoid tapered to no less than 0.3 against its closed form: round-off, of twenty points.
pub const QUADRATURE_TRAPEZOID: f64 = 1e-13;
/// The closed form of a panel without parallel sides: its terms exceed their sum some ten thousand times when
/// opposite sides meet five sides away, and more beyond.
pub const CLOSED_FORM_GENERAL: f64 = 1e-11;
/// An order of convergence read off a log-log slope, where the next order's share is still a few percent.
pub const SLOPE: f64 = 0.05;
/// Two dense eigensolvers on the same matrix, relative to the eigenvalue; scaled by the condition number where used.
pub const EIGEN_ROUND_OFF: f64 = 1e-11;
/// NASTRAN-95 holds geometry and material in single precision; relative to the largest entry.
pub const NASTRAN_SINGLE_PRECISION: f64 = 3e-7;
/// Eigenvalues of NASTRAN-95's own matrices against those of double-precision ones.
pub const NASTRAN_EIGENVALUE: f64 = 1e-6;
/// Eigenvalues that NASTRAN-95's own methods found, printed with seven digits of which it gets about six right.
pub const NASTRAN_PRINTED_EIGENVALUE: f64 = 5e-6;
/// The independent program writes ten digits and steps through some thirty finite-difference iterations.
pub const EXPECTED_HISTORY: f64 = 1e-5;
/// The same over the published numbers of iterations, thirty at most and without a tolerance in between.
pub const EXPECTED_COUNTED: f64 = 1e-6;
/// The independent program's exact frequencies, ten digits written, another quadrature order of summation.
pub const EXPECTED_FREQUENCY: f64 = 1e-6;
/// Twenty-point quadrature of a strongly distorted panel against its closed form.
pub const QUADRATURE_DISTORTED: f64 = 2e-10;
/// Goldens on another machine: the inner loop steps through some thirty finite-difference iterations, each of which
/// multiplies a difference in the last digit; two builds of the independent program differ by 1e-6.
pub const GOLDEN_RELATIVE: f64 = 1e-5;
/// Frequencies in goldens, relative: what another machine's rounding moves at the end of a correlation, with room.
pub const GOLDEN_FREQUENCY: f64 = 1e-6;
/// Gages in goldens, relative: ten times as much, for a factor moves more than the frequencies that it serves.
pub const GOLDEN_GAGE: f64 = 1e-5;
/// Percent in goldens, in points: differences of numbers that agree to a millionth.
pub const GOLDEN_PERCENT: f64 = 1e-4;
/// Numbers written for a reader: none has more than six digits, so that any other digit is another number.
pub const GOLDEN_AS_WRITTEN: f64 = 1e-7;
/// Numbers that the figure to play with solves in the page by Jacobi rotations beside the program's, of their size or of one: roots
/// that span 4e4 keep eleven digits of the smallest, and errors are differences of those.
pub const PLAYED: f64 = 1e-9;
/// The fast forms beside the plain ones, relative to the norm of a matrix, a frequency or a shape: round-off of a structural
/// stiffness whose condition is a million at most.
pub const TWO_PROGRAMS: f64 = 1e-9;
/// Whole correlations of one problem put in two ways, where they end: round-off through dozens of iterations.
pub const SAME_CORRELATION: f64 = 1e-9;
/// Relative change of test frequencies by which a correlation's amplification of small differences is measured: a hundred round-offs of
/// a mode, so that round-off does not blur it.
pub const SHAKE: f64 = 1e-12;
/// Amplification above which a drawn correlation can make [`SAME_CORRELATION`] of the round-off of its modes, which is 1e-13.
pub const MOST_AMPLIFIED: f64 = 1e3;
/// Error sums and steps on the way there, 6.3e-9 at worst (Case 2 by the norm), which the steps after them bring together again.
pub const SAME_ON_THE_WAY: f64 = 1e-7;
/// Corrections of matrices: chains of products with masses and stiffnesses of condition 100 each, relative to the largest
/// entry; the product of the conditions times `ROUND_OFF`.
pub const CORRECTION_ROUND_OFF: f64 = 1e-9;
/// A measured order of convergence falls short of the theoretical one by this much where the next order still shows.
pub const ORDER_SLACK: f64 = 0.15;
/// Cosine of a left and a right shape at which a pencil is called defective: a root of round-off, 1.5e-8, with some room.
pub const DEFECTIVE_COSINE: f64 = 1e-7;
/// Singular value below which rigid-body motions would depend on each other, in units of inches: the truss is tens of inches large.
pub const RIGID_BODY_RANK: f64 = 1e-6;
/// What round-off may take of roots of a deck and still tell a mass of another size: a percent of the least change drawn.
pub const DECK_ROOTS: f64 = 1e-4;
/// How far the wing's sensors are from grids of its deck, in: what `distance` in its job allows.
pub const PLACED_WITHIN: f64 = 1e-2;
/// Complex eigensolutions of pencils of six DOF, conditions of stiffness and shapes a few hundred together.
pub const COMPLEX_EIGEN_ROUND_OFF: f64 = 1e-10;
/// A derivative of the error sum by a 0.1 % change and first order, beside exact differences with the same step: what is
/// left is of second order in the change, a thousandth of a derivative of order one.
pub const FORWARD_DIFFERENCE: f64 = 2e-3;
/// Slopes this near an order are that order: half way to the next one.
pub const ORDER_HALFWAY: f64 = 0.45;
/// A state by Recursive 1 to roots within 1e-13, whose shapes then enter mass and stiffness products.
pub const CONVERGED_STATE: f64 = 1e-9;
/// Coefficient of the second-order terms of the error sum in the ratio of coupling to separation of two modes.
pub const FIRST_ORDER_REMAINDER: f64 = 10.0;
/// A forward difference of 0.1 % against a central one: half the step times the curvature, relative to the largest
/// derivative.
pub const CENTRAL_DIFFERENCE: f64 = 0.01;
/// The gradient against a central difference of 1e-5, relative to the largest: the step's square times a third derivative of
/// some hundreds where shapes of close modes turn, and a rounding of the error sum over the step.
pub const CENTRAL_DIFFERENCE_GRADIENT: f64 = 1e-6;
/// A force or moment that balancing leaves, relative to the sum of the magnitudes of its parts: sums over a dozen DOF.
pub const BALANCE_RESIDUAL: f64 = 1e-12;
/// Coefficients of {1} and {x}, 200 in from the reference axis on structures 20 in long: the balance equations have a
/// condition of some 1e4 when their unknowns are scaled alike.
pub const BALANCE_EQUATIONS: f64 = 1e-10;
/// What an eigensolution leaves of ω²Mv = Kv for the lowest modes, relative; scaled by the spread of ω² where used.
pub const EXACT_MODE_RESIDUAL: f64 = 1e-11;
/// Modes orthogonal to a matrix product's round-off, after a Cholesky factor and an eigensolution of a matrix that is
/// diagonal to that round-off.
pub const ORTHOGONAL_INPUT: f64 = 1e-11;
/// The balance equations with the reference axis a thousand lengths away, where their condition is 6e6.
pub const FAR_REFERENCE_AXIS: f64 = 1e-8;
/// A relative separation of 1e-10 is a difference of numbers of order one: six digits are left, half of them asked for.
pub const CANCELLED_DIFFERENCE: f64 = 1e-3;
/// Goldens of root errors in percent: below this they are round-off of roots of order one, a few units in the last place.
pub const GOLDEN_ABSOLUTE_ROOT_PERCENT: f64 = 1e-12;
/// Two update rules exact to 1e-13 in roots through the same two dozen iterations, each of which multiplies what
/// differs; the same reason as `GOLDEN_RELATIVE`, on one machine.
pub const SAME_HISTORY: f64 = 1e-6;
/// Generalized stiffness of two covers that are mirror images, relative to that of the stiffest element: condensation's condition
/// number times round-off.
pub const MIRRORED_COVERS: f64 = 1e-8;
/// Roots of a recursion that is accepted: what its residuals must prove.
pub const SETTLED_ROOTS: f64 = 1e-4;
/// Exponent of the entries of a factor by nested dissection, where cells are not powers of two and small parts are not cut: a
/// tenth of one; row by row it would be seven tenths more.
pub const FILL_ORDER: f64 = 0.1;
/// A field of 16 characters holds ten significant digits of any number: half a unit of the tenth.
pub const FIELD_ROUNDING: f64 = 5e-10;
/// It holds twelve of numbers between 1e-9 and 1e9, with a sign and an exponent.
pub const DECK_ROUNDING: f64 = 5e-12;
/// A number with which a deck is rewritten: what the crate promises.
pub const WRITTEN: f64 = 1e-6;
/// Roots of a pencil with singular mass against those of its dynamic part: round-off times the condition of the dynamic
/// flexibility, up to 1e7 for the strategy's stiffness (1e3) and T (1e2, squared), 2e5 for the box.
pub const SINGULAR_MASS_ROOT: f64 = 1e-8;
/// Frequencies by NASTRAN-95's matrices against the crate's, half of `NASTRAN_EIGENVALUE`.
pub const NASTRAN_FREQUENCY: f64 = 5e-7;
/// Gages after a correlation with NASTRAN-95 in the outer loop against the crate's own, where the inner loop follows one
/// path: its steps multiply single precision by some ten.
pub const NASTRAN_GAGE: f64 = 2e-5;
/// The same for Case 1, where NASTRAN-95's parallel-side snap changes two covers by 0.28 %, on both sides of the comparison.
pub const NASTRAN_GAGE_CASE_1: f64 = 2e-3;
/// Two runs of NASTRAN-95 on one deck, perhaps by other processors: round-off of double precision.
pub const NASTRAN_AGAIN: f64 = 1e-9;
/// Factors of snapped panels as golden/nastran95/README.md has them: half a unit of the fourth digit.
pub const PRINTED_SNAP_FACTOR: f64 = 5e-5;
/// Half a unit of the seventh digit that NASTRAN printed in 1995 or 2019, relative, at worst; the older one's single precision is in it.
pub const PRINTED_SEVEN_DIGITS: f64 = 5e-7;
/// Initial shape errors, to which the box was fitted: 7.56, 0.84 and 8.92 % where 7.67, 0.83 and 8.94 % are printed; relative.
pub const FITTED_SHAPE_ERROR: f64 = 0.02;
/// Initial RMS frequency errors of the fitted box, in percent: 12.11, 20.63 and 5.67 where 12.76, 21.11 and 5.01 are printed.
pub const FITTED_FREQUENCY_ERROR: f64 = 0.7;
/// Half a unit of the last digit of an RMS error written to 0.01 %, as a fraction.
pub const PRINTED_RMS: f64 = 5e-5;
/// Half a unit of the last digit of an error sum written to 0.1 %, as a fraction.
pub const STATED_ERROR_SUM: f64 = 5e-4;
/// Root sum of squares of nine errors printed in percent with one decimal, as a fraction: half a unit is 5e-4 of each, and
/// they differ in sign.
pub const PRINTED_SRSS: f64 = 2e-4;
/// Frequencies of the delta wing by an analog computer, a coarser model of finite differences: 12.0 % off at worst.
pub const ANALOG_FREQUENCY: f64 = 0.13;
/// How far correcting a whole matrix moves the frequency errors of modes that it was not given: an eighth of a percent.
pub const UNMEASURED_MODE: f64 = 1.25e-3;
/// A factor where the loop stops at an error sum of 0.1 % in one frequency: stiffness is twice as far off.
pub const STOPPED_FACTOR: f64 = 2e-3;
/// The first factor of one spring against its closed form: the derivative is a difference over 0.1 %.
pub const FIRST_FACTOR: f64 = 1e-3;
/// Areas of a chain of rods where the loop stops at an error sum of 0.2 %.
pub const RECOVERED_AREA: f64 = 0.01;
/// How much the joints of a chain differ in its motion on a suspension whose rods have a millionth of the chain's areas.
pub const RIGID_ON_SUSPENSION: f64 = 1e-4;
/// Covers as one group where the error is common to the group and the loop stops at the case's tolerance.
pub const GROUPED_GAGE: f64 = 0.03;
/// Components that count as equally large where the sign of a shape is chosen, relative.
pub const EQUALLY_LARGE: f64 = 1e-6;
/// The part of chi-squared that a fit by variances of few tests takes away in the mean, as it leans on numbers whose variance came out
/// small: .21 of two files, .10 of three, .01 of eight, all with one variance a shape, and .06 of twenty, in 200 or 300 jobs.
pub const LEANING: f64 = 0.21;
/// A mean, a root mean square or a correlation of a sample of normal variates, in standard errors: one in 16,000 is farther off.
pub const STANDARD_ERRORS: f64 = 4.0;
/// Roots and modes of pencils found through an inverse, shifted or not: its round-off, a thousand times for roots a thousand times
/// apart.
pub const COUNTED_ROOT: f64 = 1e-9;
/// Lowest squared frequency where stiffnesses differ 1e10 times: that many roundings of a sum of both, a few of them.
pub const UNLIKE_STIFFNESS: f64 = 1e-5;
/// Shapes of a subspace whose residual is 1e-10 of its root, divided by the distance of neighboring roots.
pub const WHOLE_SHAPE: f64 = 1e-6;
/// Stories of an exact building that five of ten floors recover without condensation, where the paper's loop stops at an error sum of a
/// tenth of a percent.
pub const RECOVERED_STORY: f64 = 0.01;
/// The same by weighted steps: what the prior's pull toward one leaves.
pub const WEIGHTED_STORY: f64 = 1e-3;
/// Two routes to one condensed analysis of the box, relative: its condition number times round-off.
pub const SAME_ANALYSIS: f64 = 1e-8;
/// A number with six digits, in the format E13.5: half a unit of the sixth, relative to a first digit of one.
pub const UNIVERSAL_ROUNDING: f64 = 5e-6;
/// Factors by Gauss–Newton where the gradient is a ten-thousandth of a standard deviation of up to a half, and the prior a
/// millionth of the least that data say.
pub const WEIGHTED_FACTOR: f64 = 1e-3;
/// How far the mean of chi-squared over its degrees of freedom may be from one over three hundred tests of some fifteen degrees
/// each: their sum has a standard deviation of 2.1 %, and 3 % is what is asked of it.
pub const MEAN_MISFIT: f64 = 0.03;
/// Coverage over three hundred tests in a golden, in percent: one at an interval's end may fall on its other side elsewhere.
pub const GOLDEN_COVERAGE: f64 = 0.34;
/// The same where one parameter alone moves: by a line through places within two percent of an end, whose distance from the curve is of the
/// square of that.
pub const LINE_TO_AN_END: f64 = 2e-3;
/// Root of twice the rise of the objective at the end of an interval: within two percent of 1.96 by a lowest objective that is itself within
/// half the square of a hundredth, beside one found ten times closer.
pub const END_OF_INTERVAL: f64 = 0.03;
/// Coverage in four tests, over a dozen parameters: their errors are correlated, so that it scatters by many percent.
pub const FEW_COVERAGE: f64 = 0.75;
/// A suspect's factor and evidence beside those of a correlation: what the prior and a basis of modes and deflections leave.
pub const SUSPECT: f64 = 0.05;
/// A factor found on a grid refined to 1 %: a step of it, and the evidence that it leaves.
pub const SINGLE_FIT_FACTOR: f64 = 0.01;
/// Results of a worked job, relative and in percent points: the steps of a correlation magnify another machine's last digit.
pub const JOB_RESULTS: f64 = 1e-4;
/// Groups of the delta wing that its ten lowest modes find without noise, with the step's own prior.
pub const JOB_WING: f64 = 0.002;
/// Squared logarithms of the box's gages that are left of what was wrong, from noisy modes.
pub const JOB_BOX: f64 = 0.25;
/// Distance of a job's factors from their optimum, in deviations: that at which its steps stop.
pub const OPTIMUM: f64 = 1e-3;
/// Gages of the delta wing by its condensed and by its whole model: condensation raises its ten modes by up to 6e-5, which the least
/// seen of its groups magnify some thirty times.
pub const CONDENSED_GAGES: f64 = 2e-3;
/// First bending of a slender wing box with posts and webs against a beam that only bends: shear makes it 0.09 % softer.
pub const SLENDER_BEAM: f64 = 2e-3;
/// The history of a case against its enclosure, times the measured condition: some roundings.
pub const CHAIN_ROUND_OFF: f64 = 1e-14;
/// Relative margin by which every decision of a history is far from falling otherwise: 4.4e-4 in the nearest.
pub const NEAREST_DECISION: f64 = 4e-4;
/// Roots of a pencil against a dense decomposition, relative to the root; the decomposition itself rounds at a part of the largest.
pub const CLUSTERED_ROOT: f64 = 1e-7;
/// The least part of a strategy's draws that reach what its law is about.
pub const LEAST_REACHED: f64 = 0.2;
/// A change of the error sum by 0.1 % of a parameter to first order, beside that of exact modes and over 0.001, where roots are 9 % apart
/// and more: 0.005 at worst. With the pairs of another state it is off by hundreds.
pub const SECOND_ORDER_CHANGE: f64 = 0.02;
/// Where Recursive 1 is far from its start and has settled to a millionth of its roots, which err by the square of what shapes do.
pub const FAR_RECURSION: f64 = 1e-3;
/// Slopes of residuals relative to the largest, beside central differences of exact analyses: a thousandth of what the modes left out
/// add is allowed, and shapes are found to 1e-8, over a step of 1e-4.
pub const EXACT_SLOPES: f64 = 2e-3;
/// Slope of the objective, in deviations of a parameter, where weighted steps stop by their gradient: the tolerance of a job's steps.
pub const STATIONARY: f64 = 1e-5;
/// Error of slopes, relative to them: it moves a stop by as much times the root of chi-squared, in deviations.
pub const SLOPES_TOLD: f64 = 1e-6;
/// Chi-squared of a stop against that of the certified optimum. Beside the optimum it moves by twice the root of the prior's pull, 0.5 to
/// 1.7, for every deviation that all factors together are off, and slopes within [`STATIONARY`] leave 3 to 13 times as many; 8e-7 at worst.
pub const CERTIFIED_CHI_SQUARED: f64 = 2.2e-4;
/// Deviations of factors that are told of another test, relative to those of that test: slopes err by a millionth, and where parameters
/// are hard to tell apart a deviation magnifies it some ten times.
pub const MEASURED_NEXT: f64 = 1e-5;
/// A number of three digits in percent, such as 4.18.
pub const THREE_DIGITS: f64 = 0.005;
