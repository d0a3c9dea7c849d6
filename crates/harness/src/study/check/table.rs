//! mistakes.toml: what may be wrong, in words and as numbers.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Largest number of mistakes that are named: the best one and those that fit as well.
pub(super) const MOST_CAUSES: usize = 3;

/// The entries of mistakes.toml.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    pub value: Vec<Value>,
    pub contact: Vec<Quantity>,
    pub run: Vec<Quantity>,
    pub law: Vec<Flags>,
    pub loading: Vec<Flags>,
    /// Columns that are likely to share a mistake.
    pub group: Vec<Group>,
    /// Usual causes by the name of an item.
    usual: BTreeMap<String, String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Group {
    pub is: String,
    pub columns: Vec<String>,
}

/// A wrong value of a number x: `factor` × `function`(x)^`power` × `times`^`exponent`, for names that contain `only`.
#[derive(Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Value {
    pub says: String,
    pub factor: f64,
    pub power: f64,
    pub times: String,
    pub exponent: f64,
    pub function: String,
    pub only: String,
}

impl Default for Value {
    fn default() -> Self {
        let [says, times, function, only] = std::array::from_fn(|_| String::new());
        Self {
            says,
            factor: 1.0,
            power: 1.0,
            times,
            exponent: 1.0,
            function,
            only,
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Quantity {
    pub is: String,
    pub fields: Vec<String>,
    #[serde(default)]
    pub parameter: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Flags {
    pub says: String,
    pub set: Vec<(String, f64)>,
}

pub(super) static TABLE: LazyLock<Table> = LazyLock::new(|| {
    toml::from_str(include_str!("mistakes.toml")).expect("mistakes.toml is tested")
});

impl Value {
    /// Returns the value in place of `asked`. `other` is the friction of the other contacts, and `number` gives
    /// numbers of the task by name.
    pub fn of(&self, asked: f64, other: f64, number: impl Fn(&str) -> f64) -> f64 {
        let based = match self.function.as_str() {
            "tan" => libm::tan(asked),
            "atan" => libm::atan(asked),
            "tan-of-degrees" => libm::tan(asked.to_radians()),
            "degrees" => libm::atan(asked).to_degrees(),
            "sin-of-angle" => libm::sin(libm::atan(asked)),
            "other" => other,
            "mean" => 0.5 * (asked + other),
            "geometric-mean" => (asked * other).sqrt(),
            "harmonic-mean" => 2.0 * asked * other / (asked + other),
            "product" => asked * other,
            "sum" => asked + other,
            "least" => asked.min(other),
            "largest" => asked.max(other),
            _ => asked,
        };
        let times = match self.times.as_str() {
            "" => 1.0,
            name => libm::pow(number(name), self.exponent),
        };
        let powered = if self.power == 1.0 {
            based
        } else {
            libm::pow(based, self.power)
        };
        self.factor * powered * times
    }
}

/// Returns the meanings of the values that give `found` in place of `asked`, a number called `name`.
pub(super) fn meanings(
    name: &str,
    found: f64,
    asked: f64,
    other: f64,
    number: impl Fn(&str) -> f64,
) -> Vec<String> {
    const DIGITS: f64 = 1e-4;
    let own = TABLE
        .value
        .iter()
        .filter(|value| name.contains(&value.only));
    let fitting = own.filter(|value| {
        let told = value.of(asked, other, &number);
        (found - told).abs() <= DIGITS * told.abs().max(1e-5 * asked.abs())
    });
    let mut texts: Vec<String> = fitting.map(|value| value.says.clone()).collect();
    texts.truncate(MOST_CAUSES);
    texts
}

/// Returns the usual causes of an item that failed.
pub(super) fn usual(item: &str) -> String {
    let own = TABLE
        .usual
        .get(item)
        .or_else(|| TABLE.usual.get("loading path"));
    format!("usual causes: {}", own.map_or("", String::as_str))
}
