use corfem::cases::*;
fn main() {
    for n in CASES {
        let r = run_case(&Case::new(n).unwrap(), |_, _| {}).unwrap();
        println!("case {n} {:?} {:.10} {:.10}", r.correlation.initial.frequencies_hz, r.correlation.initial.errors.frequency_rms(), r.correlation.initial.errors.shape_rms());
        for (p, g) in r.correlation.passes.iter().zip(&r.pass_gages) {
            println!("  {} {:?} {:?}\n {:?} {:?}\n {:.10} {:.10}", p.inner.iterations.len(), p.inner.stop, p.inner.iterations.iter().map(|i| i.errors.sum()).collect::<Vec<_>>(), g, p.check.frequencies_hz, p.check.errors.frequency_rms(), p.check.errors.shape_rms());
        }
        println!("  {:?} {:?}", r.unlimited_factors(), r.anomalies);
    }
}
