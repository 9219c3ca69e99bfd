//! The TeX of `paper/equations.toml`, executed. A value is a complex matrix, a number one of 1 × 1, a vector a column. Eight rules:
//!
//! 1. A formula is clauses between `\quad`s: an equation `left = right`, or a condition `i \ne j` on all of them.
//! 2. Factors side by side multiply in the order written, matrices as matrices; `/` divides by the one factor behind it.
//! 3. A number that is added to a matrix stands for so many times the unit matrix.
//! 4. `^t` transposes, `^{-1}` inverts; another power is of a number.
//! 5. Of a subscript the longest part that makes a known letter belongs to it; indices follow, and digits count from one.
//! 6. A matrix with one index is its column; a family with one index, or with an order in parentheses above it, is its member.
//! 7. `\sum` and `\max` bind their index to the one term behind them, without what stands after `\ne`.
//! 8. A clause whose left side is a letter that nothing gives defines it, for all its indices.

use crate::prelude::*;

pub type Value = DMatrix<Complex<f64>>;
/// Ranges of indices, or where they are, from zero.
pub type Places = BTreeMap<char, usize>;
pub type Letters = BTreeMap<String, Letter>;
/// Why a formula does not run; an index alone if that stands nowhere yet.
pub type Refused = String;

#[derive(Clone)]
pub enum Letter {
    One(Value),
    Family(BTreeMap<usize, Value>),
}

/// A reader of one side of a clause.
pub struct Formula<'a> {
    tokens: Vec<&'a str>,
    at: usize,
    letters: &'a Letters,
    ranges: &'a Places,
    index: Places,
    /// Whether letters lose their signs and all terms are added: how large what cancels is.
    is_size: bool,
}

pub fn number(x: f64) -> Value {
    Value::from_element(1, 1, x.into())
}

/// Commands, decimals and single characters, without spaces, commas and sizes of brackets.
fn tokens(mut rest: &str) -> Vec<&str> {
    let mut found = Vec::new();
    while !rest.is_empty() {
        let run = |start: usize, of: fn(&char) -> bool| {
            start + rest[start..].chars().take_while(of).count()
        };
        let length = match rest.as_bytes() {
            [b'\\', ..] => run(1, char::is_ascii_alphabetic).max(2),
            [_, b'.', ..] => run(2, char::is_ascii_digit),
            _ => 1,
        };
        let (token, after) = rest.split_at(length);
        found.push(token);
        rest = after;
    }
    found.retain(|token| ![" ", ",", "\\big", "\\Big"].contains(token));
    found
}

impl<'a> Formula<'a> {
    pub fn new(text: &'a str, letters: &'a Letters, ranges: &'a Places, index: &Places) -> Self {
        let digits = ('1'..='9').zip(0..);
        let index = index.clone().into_iter().chain(digits).collect();
        Self {
            tokens: tokens(text),
            at: 0,
            letters,
            ranges,
            index,
            is_size: false,
        }
    }

    pub fn value(mut self) -> Result<Value, Refused> {
        let value = self.sum()?;
        match self.peek() {
            "" => Ok(value),
            token => Err(format!("{token} is left over")),
        }
    }

    /// How large the terms of the side are.
    pub fn size(mut self) -> Result<f64, Refused> {
        self.is_size = true;
        Ok(self.value()?.camax())
    }

    /// The new letter and the indices of a side that is nothing else (rule 8).
    pub fn defines(mut self) -> Option<(String, Vec<char>)> {
        let (name, mut letters) = self.name();
        let is_name = |token: &&str| {
            token
                .parse()
                .is_ok_and(|index| !self.ranges.contains_key(&index))
        };
        let start = letters.iter().rposition(is_name).map_or(0, |last| last + 1);
        let indices = letters.split_off(start).concat().chars().collect();
        let name = full(&name, &letters);
        (self.peek().is_empty() && !name.is_empty() && !self.letters.contains_key(&name))
            .then_some((name, indices))
    }

    fn peek(&self) -> &'a str {
        self.tokens.get(self.at).copied().unwrap_or("")
    }

    fn take(&mut self) -> &'a str {
        let token = self.peek();
        self.at += 1;
        token
    }

    fn takes(&mut self, token: &str) -> bool {
        let is_next = self.peek() == token;
        self.at += usize::from(is_next);
        is_next
    }

    /// The tokens of a subscript without its braces, or the one token that has none.
    fn subscript(&mut self) -> Vec<&'a str> {
        if !self.takes("_") {
            return Vec::new();
        }
        if !self.takes("{") {
            return vec![self.take()];
        }
        let rest = &self.tokens[self.at..];
        let found = rest
            .iter()
            .copied()
            .take_while(|token| *token != "}")
            .collect_vec();
        self.at += found.len() + 1;
        found
    }

    fn sum(&mut self) -> Result<Value, Refused> {
        let mut total = number(0.0);
        loop {
            let is_minus = !self.takes("+") && self.takes("-") && !self.is_size;
            let term = self.term()?;
            total = add(total, if is_minus { -term } else { term })?;
            if !["+", "-"].contains(&self.peek()) {
                return Ok(total);
            }
        }
    }

    fn term(&mut self) -> Result<Value, Refused> {
        let mut product = self.factor()?;
        while !"+-)]}|".contains(self.peek()) {
            let is_below = self.takes("/");
            let factor = self.factor()?;
            product = times(product, if is_below { inverse(factor)? } else { factor })?;
        }
        Ok(product)
    }

    fn factor(&mut self) -> Result<Value, Refused> {
        let token = self.peek();
        let mut value = match token {
            "\\sum" | "\\max" => return self.total(),
            "(" | "[" | "{" | "|" => {
                self.take();
                let value = self.sum()?;
                self.take();
                value.map(|x| if token == "|" { x.norm().into() } else { x })
            }
            "\\frac" => {
                self.take();
                let above = self.factor()?;
                times(above, inverse(self.factor()?)?)?
            }
            _ => match token.parse() {
                Ok(x) if self.takes(token) => number(x),
                _ => self.letter()?,
            },
        };
        while self.takes("^") {
            if self.takes("t") {
                value = value.transpose();
                continue;
            }
            let is_size = std::mem::take(&mut self.is_size);
            let power = self.factor()?[0].re;
            self.is_size = is_size;
            value = match value.len() {
                1 => value.map(|x| x.powf(power)),
                _ if power == -1.0 => inverse(value)?,
                _ => return Err("a matrix has no power".into()),
            };
        }
        Ok(value)
    }

    /// The sum or the largest of a term over the values of an index (rule 7).
    fn total(&mut self) -> Result<Value, Refused> {
        let is_sum = self.take() == "\\sum";
        let condition = self.subscript().concat();
        let (index, others) = condition.split_once("\\ne").unwrap_or((&condition, ""));
        let index = index.trim_end_matches("=1").parse();
        let index = index.map_err(|_| "no index is bound")?;
        let range = *self.ranges.get(&index).ok_or("an index has no range")?;
        let is_other = self.takes("^") && self.factor()? != number(range as f64);
        let (start, mut total) = (self.at, number(0.0));
        for value in 0..range {
            if self.index.insert(index, value).is_some_and(|_| value == 0) || is_other {
                return Err("an index is bound already, or has another range".into());
            }
            self.at = start;
            let term = self.term()?;
            if !is_sum {
                total[0].re = total[0].re.max(term[0].re);
            } else if !others
                .chars()
                .any(|other| self.index.get(&other) == Some(&value))
            {
                total = add(total, term)?;
            }
        }
        self.index.remove(&index);
        Ok(total)
    }

    /// A letter and its subscript, not yet told apart (rule 5).
    fn name(&mut self) -> (String, Vec<&'a str>) {
        let mut name = self.take().to_owned();
        if ["\\Delta", "\\lbrace"].contains(&&*name) {
            name += self.take();
            self.takes("\\rbrace");
        }
        (name, self.subscript())
    }

    fn letter(&mut self) -> Result<Value, Refused> {
        let (name, subscript) = self.name();
        let known = |length| {
            Some((
                length,
                self.letters.get(&full(&name, &subscript[..length]))?,
            ))
        };
        let (length, letter) = (0..=subscript.len())
            .rev()
            .find_map(known)
            .ok_or(name + " is unknown")?;
        let place = |token: &&str| {
            token
                .parse()
                .ok()
                .and_then(|index: char| self.index.get(&index).copied())
                .ok_or(token.to_string())
        };
        let mut indices = subscript[length..]
            .iter()
            .map(place)
            .collect::<Result<Vec<_>, _>>()?;
        let value = match letter {
            Letter::One(value) => value,
            Letter::Family(members) => {
                let member = if self.takes("^") {
                    self.factor()?[0].re as usize - 1
                } else if indices.is_empty() {
                    usize::MAX
                } else {
                    indices.remove(0)
                };
                members.get(&member).ok_or("a member is unknown")?
            }
        };
        let (rows, columns) = value.shape();
        let value = match *indices {
            [] => value.clone(),
            [i] if columns == 1 && i < rows => value.rows(i, 1).into(),
            [j] if columns > 1 && j < columns => value.columns(j, 1).into(),
            [i, j] if i < rows && j < columns => number(0.0) + value.view((i, j), (1, 1)),
            _ => return Err("indices do not fit".into()),
        };
        Ok(value.map(|x| if self.is_size { x.norm().into() } else { x }))
    }
}

fn full(name: &str, part: &[&str]) -> String {
    let full = format!("{name}_{}", part.concat());
    full.trim_end_matches('_').to_owned()
}

pub fn add(a: Value, b: Value) -> Result<Value, Refused> {
    let unit = |x: &Value, like: &Value| match x.len() {
        1 => Value::from_diagonal_element(like.nrows(), like.ncols(), x[0]),
        _ => x.clone(),
    };
    let (a, b) = (unit(&a, &b), unit(&b, &a));
    if a.shape() == b.shape() {
        Ok(a + b)
    } else {
        Err("shapes do not add".into())
    }
}

fn times(a: Value, b: Value) -> Result<Value, Refused> {
    match (a.len(), b.len()) {
        (1, _) => Ok(b * a[0]),
        (_, 1) => Ok(a * b[0]),
        _ if a.ncols() == b.nrows() => Ok(a * b),
        _ => Err("shapes do not multiply".into()),
    }
}

fn inverse(a: Value) -> Result<Value, Refused> {
    Ok(a.try_inverse().ok_or("there is no inverse")?)
}
