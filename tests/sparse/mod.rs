//! The fast forms beside the plain ones: two programs and one answer.

pub mod equals_the_method;
