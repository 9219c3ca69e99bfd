//! The planform as a rule: where the grids are, how they are numbered, and what lies between them.

/// Stations outboard of the root's center, in.
pub(super) const STATIONS: [f64; 6] = [0.0, 10.0, 30.0, 50.0, 70.0, 90.0];
/// Lines forward of the trailing edge, in.
pub(super) const LINES: [f64; 5] = [0.0, 20.0, 40.0, 60.0, 80.0];
/// Where the leading edge is: the sum of both coordinates, in.
const LEADING_EDGE: f64 = 110.0;
/// The station at the side of the body, where the wing is supported.
pub(super) const SUPPORTED_STATION: usize = 2;
/// Grid numbers from one line to the next.
const LINE_STEP: usize = 20;
/// Grid numbers from the mid-plane to the upper surface.
pub(super) const SURFACE_STEP: usize = 10;

/// How many stations a line has behind the leading edge.
pub(super) fn stations_on(line: usize) -> usize {
    STATIONS.iter().filter(|x| **x + LINES[line] <= LEADING_EDGE).count()
}

/// How many lines a station has behind the leading edge.
pub(super) fn lines_at(station: usize) -> usize {
    LINES.iter().filter(|y| STATIONS[station] + **y <= LEADING_EDGE).count()
}

/// Number of the grid in the mid-plane.
pub(super) fn mid_grid(line: usize, station: usize) -> usize {
    LINE_STEP * line + station + 1
}

/// Number of the grid on the upper surface.
pub(super) fn upper_grid(line: usize, station: usize) -> usize {
    mid_grid(line, station) + SURFACE_STEP
}

/// Mid-plane grids at the ends of every member along a line, line by line from the root out.
pub(super) fn along_lines() -> Vec<[usize; 2]> {
    let side = |line, station| [mid_grid(line, station - 1), mid_grid(line, station)];
    (0..LINES.len()).flat_map(|line| (1..stations_on(line)).map(move |station| side(line, station))).collect()
}

/// The same along every station but the first: nothing shears the plane of symmetry.
pub(super) fn along_stations() -> Vec<[usize; 2]> {
    let side = |line, station| [mid_grid(line - 1, station), mid_grid(line, station)];
    (1..STATIONS.len()).flat_map(|station| (1..lines_at(station)).map(move |line| side(line, station))).collect()
}

/// Mid-plane grids on the leading edge, from the tip in.
pub(super) fn leading_edge() -> Vec<usize> {
    (1..LINES.len()).map(|line| mid_grid(line, stations_on(line) - 1)).collect()
}
