//! Gauss-Legendre quadrature on the interval from −1 to 1.

/// Points and weights of the `count`-point Gauss-Legendre rule,
/// $\int_{-1}^{1} f(s) \thinspace ds \approx \sum_k w_k f(s_k)$, exact for polynomials up to degree $2n-1$.
///
/// The points are the roots of the Legendre polynomial $P_n$, found by Newton's method from
/// $\cos\big(\pi (k - 1/4)/(n + 1/2)\big)$; the weights are $2/\big((1-s_k^2)P_n^\prime(s_k)^2\big)$.
/// Points ascend. Source: Abramowitz and Stegun, *Handbook of Mathematical Functions*, 25.4.29.
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    // Newton converges quadratically from this start: six steps are more than double precision can use.
    const NEWTON_STEPS: usize = 8;
    (1..=count)
        .rev()
        .map(|k| {
            let mut s = (std::f64::consts::PI * (k as f64 - 0.25) / (count as f64 + 0.5)).cos();
            for _ in 0..NEWTON_STEPS {
                let (value, slope) = legendre(count, s);
                s -= value / slope;
            }
            let (_, slope) = legendre(count, s);
            (s, 2.0 / ((1.0 - s * s) * slope * slope))
        })
        .collect()
}

/// $P_n(s)$ and $P_n^\prime(s)$ by the three-term recurrence.
fn legendre(n: usize, s: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, s);
    for m in 2..=n {
        let m = m as f64;
        (before, value) = (
            value,
            ((2.0 * m - 1.0) * s * value - (m - 1.0) * before) / m,
        );
    }
    (value, n as f64 * (s * value - before) / (s * s - 1.0))
}
