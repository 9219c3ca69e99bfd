//! Small drawings that stand inside a text: they take its color, and need nothing from elsewhere.

use std::fmt::Write;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    Line,
    Dashed,
    Dots,
    Bars,
}

/// Numbers drawn together, with what they are called.
#[derive(Debug, Clone)]
pub struct Series {
    pub name: &'static str,
    pub mark: Mark,
    pub points: Vec<(f64, f64)>,
}

impl Series {
    pub fn new(
        name: &'static str,
        mark: Mark,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            name,
            mark,
            points: points.into_iter().collect(),
        }
    }
}

/// A diagram: what its axes are called, from where to where they go, and what stands in it.
#[derive(Debug, Clone)]
pub struct Sketch {
    pub title: &'static str,
    pub labels: [&'static str; 2],
    pub x: (f64, f64),
    pub y: (f64, f64),
    pub is_logarithmic: bool,
    pub series: Vec<Series>,
}

const SIZE: (f64, f64) = (520.0, 270.0);
/// Left, top, right and bottom of the frame.
const FRAME: [f64; 4] = [58.0, 12.0, 506.0, 222.0];
/// Seen on white and on black alike.
const COLORS: [&str; 4] = ["#3b82c4", "#d9822b", "#4a9e5c", "#b05fb5"];

/// Steps of one, two or five that divide a range into about six.
fn ticks((low, high): (f64, f64)) -> (Vec<f64>, usize) {
    let rough = (high - low) / 6.0;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|n| n * power)
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(power);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    ((first..=last).map(|n| n as f64 * step).collect(), decimals)
}

impl Sketch {
    fn height(&self, y: f64) -> f64 {
        let scale = |y: f64| if self.is_logarithmic { y.log10() } else { y };
        let (low, high) = (scale(self.y.0), scale(self.y.1));
        FRAME[3] - (scale(y) - low) / (high - low) * (FRAME[3] - FRAME[1])
    }

    fn across(&self, x: f64) -> f64 {
        FRAME[0] + (x - self.x.0) / (self.x.1 - self.x.0) * (FRAME[2] - FRAME[0])
    }

    fn axes(&self, svg: &mut String) {
        let [left, top, right, bottom] = FRAME;
        let (xs, x_decimals) = ticks(self.x);
        for x in xs {
            let at = self.across(x);
            let _ = writeln!(
                svg,
                r#"<path d="M{at:.1} {bottom:.1}v4" stroke="currentColor"/>"#
            );
            let _ = writeln!(
                svg,
                r#"<text x="{at:.1}" y="238" text-anchor="middle">{x:.x_decimals$}</text>"#
            );
        }
        // Every power of ten, or every other where there are many.
        let powers = |(low, high): (f64, f64)| {
            let (low, high) = (low.log10().round() as i32, high.log10().round() as i32);
            (low..=high).step_by(if high - low > 7 { 2 } else { 1 })
        };
        let ys: Vec<(f64, String)> = if self.is_logarithmic {
            powers(self.y)
                .map(|power| (10f64.powi(power), format!("1e{power}")))
                .collect()
        } else {
            let (ys, decimals) = ticks(self.y);
            ys.into_iter()
                .map(|y| (y, format!("{y:.decimals$}")))
                .collect()
        };
        for (y, text) in ys {
            let at = self.height(y);
            let _ = writeln!(
                svg,
                r#"<path d="M{left} {at:.1}H{right}" stroke="currentColor" stroke-opacity="0.2"/>"#
            );
            let base = at + 4.0;
            let _ = writeln!(
                svg,
                r#"<text x="52" y="{base:.1}" text-anchor="end">{text}</text>"#
            );
        }
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            svg,
            r#"<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="currentColor"/>"#
        );
        let middle = 0.5 * (left + right);
        let _ = writeln!(
            svg,
            r#"<text x="{middle}" y="258" text-anchor="middle">{}</text>"#,
            self.labels[0]
        );
        let middle = 0.5 * (top + bottom);
        let _ = writeln!(
            svg,
            r#"<text transform="translate(12 {middle}) rotate(-90)" text-anchor="middle">{}</text>"#,
            self.labels[1]
        );
    }

    fn series(&self, svg: &mut String, row: usize) {
        let Series { name, mark, points } = &self.series[row];
        let color = COLORS[row % COLORS.len()];
        let places: Vec<(f64, f64)> = points
            .iter()
            .map(|&(x, y)| (self.across(x), self.height(y)))
            .collect();
        match mark {
            Mark::Line | Mark::Dashed => {
                let path: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
                let dash = if *mark == Mark::Dashed { r#" stroke-dasharray="6 4""# } else { "" };
                let d = path.join("L");
                let _ = writeln!(svg, r#"<path d="M{d}" fill="none" stroke="{color}" stroke-width="2"{dash}/>"#);
            }
            Mark::Dots => places.iter().for_each(|(x, y)| {
                let _ = writeln!(svg, r#"<circle cx="{x:.1}" cy="{y:.1}" r="4" fill="{color}"/>"#);
            }),
            Mark::Bars => places.iter().for_each(|(x, y)| {
                let ground = self.height(if self.is_logarithmic { self.y.0 } else { 0.0 });
                let (top, height, left) = (y.min(ground), (y - ground).abs(), x - 7.0);
                let _ = writeln!(
                    svg,
                    r#"<rect x="{left:.1}" y="{top:.1}" width="14" height="{height:.1}" fill="{color}"/>"#
                );
            }),
        }
        let (y, base) = (26 + 16 * row, 30 + 16 * row);
        let _ = writeln!(
            svg,
            r#"<text x="474" y="{base}" text-anchor="end">{name}</text>"#
        );
        let _ = writeln!(
            svg,
            r#"<path d="M480 {y}h18" stroke="{color}" stroke-width="4"/>"#
        );
    }

    /// The drawing as it stands in a text.
    pub fn svg(&self) -> String {
        let (width, height) = SIZE;
        let style = "max-width: 100%; height: auto";
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             style=\"{style}\" role=\"img\" font-size=\"12\" fill=\"currentColor\">\n<title>{}</title>\n",
            self.title
        );
        self.axes(&mut svg);
        (0..self.series.len()).for_each(|row| self.series(&mut svg, row));
        svg + "</svg>"
    }
}

#[test]
fn a_sketch_puts_points_where_its_axes_say() {
    let points = [(0.0, 0.0), (1.0, 10.0)];
    let series = vec![
        Series::new("a", Mark::Line, points),
        Series::new("b", Mark::Dots, points),
    ];
    let sketch = Sketch {
        title: "t",
        labels: ["x", "y"],
        x: (0.0, 1.0),
        y: (0.0, 10.0),
        is_logarithmic: false,
        series,
    };
    let svg = sketch.svg();
    assert!(svg.contains("M58.0 222.0L506.0 12.0"), "{svg}");
    assert!(svg.contains(r#"cx="506.0" cy="12.0""#) && !svg.contains("\n\n"));
    assert_eq!(ticks((0.0, 10.0)), (vec![0.0, 2.0, 4.0, 6.0, 8.0, 10.0], 0));
    assert_eq!(ticks((-0.5, 1.0)).0.len(), 4);
}
