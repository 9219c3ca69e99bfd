//! Properties by proptest, of values whose type one runner need not know: it is compiled once, not for every property.

use crate::prelude::*;
use proptest::strategy::BoxedStrategy;
use proptest::test_runner::TestCaseResult;
use std::any::Any;
use std::fmt::{self, Formatter};

/// `proptest!` of patterns in strategies, with [`config`] where no other configuration is given.
macro_rules! properties {
    (#![proptest_config($config:expr)] $(
        $(#[$about:meta])*
        fn $name:ident($($value:pat in $strategy:expr),+ $(,)?) $law:block
    )*) => { $(
        $(#[$about])*
        fn $name() {
            let config = $crate::prelude::Config {
                source_file: Some(file!()),
                test_name: Some(concat!(module_path!(), "::", stringify!($name))),
                ..$config
            };
            let values = stringify!($($value),+);
            $crate::common::properties::check(config, values, ($($strategy,)+), |($($value,)+)| {
                let (): () = $law;
                Ok(())
            });
        }
    )* };
    (#[$($first:tt)*] $($laws:tt)*) => {
        properties! { #![proptest_config($crate::common::config())] #[$($first)*] $($laws)* }
    };
}

/// What a strategy drew, and the patterns that it is for.
struct Drawn {
    patterns: &'static str,
    values: Box<dyn Values>,
}

trait Values: Any + Debug {}

impl<T: Any + Debug> Values for T {}

impl Debug for Drawn {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} = {:#?}", self.patterns, self.values)
    }
}

/// Asks a law of what a strategy draws.
#[track_caller]
pub fn check<S>(
    config: Config,
    patterns: &'static str,
    strategy: S,
    law: impl Fn(S::Value) -> TestCaseResult,
) where
    S: Strategy<Value: 'static> + 'static,
{
    let drawn = strategy.prop_map(move |values| Drawn {
        patterns,
        values: Box::new(values),
    });
    run(config, &drawn.boxed(), &|Drawn { values, .. }| {
        let values: Box<dyn Any> = values;
        law(*values.downcast().unwrap())
    });
}

#[track_caller]
fn run(config: Config, drawn: &BoxedStrategy<Drawn>, law: &dyn Fn(Drawn) -> TestCaseResult) {
    let mut runner = TestRunner::new(config);
    if let Err(error) = runner.run(drawn, law) {
        panic!("{error}\n{runner}");
    }
}
