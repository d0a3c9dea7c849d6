//! What rounding of the reported numbers does to the properties that are read from them.
//!
//! A regression knows how far its rows scatter, but not that the numbers in its terms are rounded, too. So the
//! numbers are rounded once more: each is moved at random by up to half a unit of its last place, and the properties
//! are read again. They move by about as much as the first rounding has moved them (simulation and extrapolation, Cook
//! and Stefanski 1994).

use super::finding::{Property, VELOCITY_LAG};
use super::regression::Measured;
use crate::series::{Column, EXACT_DIGITS, Motion, MotionRow};
use crate::series::{TELLING, TELLING_DIGITS, decimal, is_of_32_bits};

/// Number of times that the numbers are moved.
const REPETITIONS: u64 = 8;

/// The uncertainty in units of the largest change. The largest of eight random changes is nearly two standard deviations, so
/// that this is between three and four of them, as uncertainties of regressions are three standard errors.
const COVERAGE: f64 = 2.0;

/// Units of the columns of motions, and what has them.
const QUANTITIES: [(&str, &str); 5] = [
    ("r", "positions"),
    ("r √(k_n/m)", "velocities"),
    ("√(k_n/m)", "spins"),
    ("k_n r", "forces"),
    ("k_n r²", "torques"),
];

/// Share of the largest change that the mean change has, if the changes are not random.
const SYSTEMATIC: f64 = 0.5;

/// Largest change that may be the rounding of our own arithmetic: where numbers are rounded less than that, further
/// roundings show nothing. Properties are numbers of order 1, and coefficients come from up to a thousand rows, a digit or two
/// apart.
const ARITHMETIC: f64 = 1e-12;

/// Largest uncertainty of the moment to which velocities belong, in steps, at which laws can be read from them.
const LARGEST_LAG: f64 = 0.1;

/// How the numbers of some motions are rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct Rounding {
    /// Number of significant digits of the longest number.
    pub digits: u32,
    /// Power of ten of the last place of all numbers, which is that of fixed decimals.
    last_place: i32,
    /// The units of the quantities in single precision.
    single: Vec<&'static str>,
}

impl Rounding {
    /// Infers the rounding of the numbers in `motions`.
    pub fn of(motions: &[&Motion]) -> Self {
        let units = QUANTITIES.into_iter().map(|(unit, _)| unit);
        let single = units.filter(|unit| is_single(motions, unit));
        let mut own = Self {
            digits: 0,
            last_place: i32::MAX,
            single: single.collect(),
        };
        for value in values(motions) {
            let (digits, exponent) = decimal(value);
            own.digits = own.digits.max(digits);
            own.last_place = own.last_place.min(exponent - digits as i32 + 1);
            if own.digits >= EXACT_DIGITS {
                break;
            }
        }
        own
    }

    /// Whether positions are in single precision.
    pub fn has_single_positions(&self) -> bool {
        self.single.contains(&QUANTITIES[0].0)
    }

    /// Whether any quantity is in single precision.
    pub fn is_single(&self) -> bool {
        !self.single.is_empty()
    }

    /// The quantities in single precision, in words.
    pub fn single_quantities(&self) -> Vec<&'static str> {
        let named = QUANTITIES
            .iter()
            .filter(|(unit, _)| self.single.contains(unit));
        named.map(|(_, name)| *name).collect()
    }

    /// Adds to the uncertainty of each of `properties` how far it moves if the numbers of `motions`, in the order in
    /// which `read` takes them, are rounded once more. Nothing is added if they have all digits of double precision.
    pub fn widen(
        &self,
        properties: &mut [Property],
        motions: &[Vec<Motion>],
        read: impl Fn(&[Vec<Motion>]) -> Vec<Property>,
    ) {
        if self.digits >= EXACT_DIGITS && !self.is_single() {
            return;
        }
        let mut random = fastrand::Rng::with_seed(0);
        let mut values = |scale: f64| -> Vec<Vec<f64>> {
            let each = (0..REPETITIONS).map(|_| {
                let rounded = motions.iter().map(|round| {
                    let round = round.iter();
                    round
                        .map(|motion| self.moved(motion, scale, &mut random))
                        .collect()
                });
                let found = read(&rounded.collect::<Vec<_>>());
                let value = |own: &Property| {
                    let other = found.iter().find(|other| other.name == own.name);
                    other.map_or(f64::NAN, |other| other.measured.value)
                };
                properties.iter().map(value).collect()
            });
            each.collect()
        };
        let [once, thrice] = [1.0, 3f64.sqrt()].map(&mut values);
        for (place, own) in properties.iter_mut().enumerate() {
            let Measured { value, uncertainty } = own.measured;
            let changes = |all: &[Vec<f64>]| -> Vec<f64> {
                let changes = all.iter().map(|values| values[place] - value);
                changes.collect()
            };
            let further = moved_by_rounding(&changes(&once), &changes(&thrice));
            own.measured = Measured::new(value, uncertainty + COVERAGE * further);
        }
        let lag = properties.iter().find(|own| own.name == VELOCITY_LAG);
        if lag.is_none_or(|own| own.measured.uncertainty > LARGEST_LAG) {
            for own in properties.iter_mut() {
                own.measured.uncertainty = f64::INFINITY;
            }
        }
    }

    /// `motion` with every number moved by up to half a unit in its last place, times a `scale`.
    fn moved(&self, motion: &Motion, scale: f64, random: &mut fastrand::Rng) -> Motion {
        with_numbers(motion, |column, value| {
            let unit = scale * self.unit(value, column.unit);
            value + unit * (random.f64() - 0.5)
        })
    }

    /// The unit in the last place of a `value` in this physical `unit`.
    fn unit(&self, value: f64, unit: &str) -> f64 {
        if value == 0.0 {
            return 0.0;
        }
        let printed = match self.digits >= EXACT_DIGITS {
            true => 0.0,
            false => {
                let (_, exponent) = decimal(value);
                let place = (exponent - self.digits as i32 + 1).max(self.last_place);
                libm::exp10(f64::from(place))
            }
        };
        let single = match self.single.contains(&unit) && is_of_32_bits(value) {
            true => value.abs() * f64::from(f32::EPSILON),
            false => 0.0,
        };
        printed.max(single)
    }
}

/// How far rounding has moved a property that changes by `once` if the numbers are rounded once more, and by `thrice` if
/// the squares of those roundings are three times as large.
///
/// Rounding of the terms of a regression makes its coefficients smaller, to a + b/(c + λ) for λ roundings, and once there is
/// more rounding than motion, further roundings change little. The means of the changes give c, and what the first
/// rounding has done is (c + 2)/c of what the second one does.
fn moved_by_rounding(once: &[f64], thrice: &[f64]) -> f64 {
    let mean = |changes: &[f64]| changes.iter().sum::<f64>() / changes.len() as f64;
    let largest = |changes: &[f64]| {
        let changes = changes.iter().map(|change| change.abs());
        changes.fold(
            0.0,
            |largest: f64, own| if own <= largest { largest } else { own },
        )
    };
    let (one, three, largest) = (mean(once), mean(thrice), largest(once));
    if !largest.is_finite() {
        return f64::INFINITY;
    }
    // Otherwise the changes are random, and as large as that of the first rounding.
    let is_systematic = largest > ARITHMETIC && one.abs() > SYSTEMATIC * largest;
    let ratio = three / one;
    let factor = match is_systematic && ratio < 3.0 {
        true if ratio <= 1.5 => f64::INFINITY,
        // 2/c, with (4 ratio − 6)/(3 − ratio) for c.
        true => 1.0 + (3.0 - ratio) / (2.0 * ratio - 3.0),
        false => 1.0,
    };
    largest * factor
}

/// The columns of motions but for the step.
fn columns() -> impl Iterator<Item = &'static Column<MotionRow>> {
    MotionRow::columns(true).iter().skip(1)
}

/// `motion` with every number but the step replaced, as long as all of them are finite.
pub(super) fn with_numbers(
    motion: &Motion,
    mut number: impl FnMut(&Column<MotionRow>, f64) -> f64,
) -> Motion {
    let rows = motion.rows().iter().map(|row| {
        let mut own = *row;
        for column in columns() {
            (column.set)(&mut own, number(column, (column.value)(row)));
        }
        own
    });
    let rows: Vec<MotionRow> = rows.collect();
    let steps = rows.len().saturating_sub(1) as u64;
    Motion::new(rows, steps).unwrap_or_else(|_| motion.clone())
}

fn values(motions: &[&Motion]) -> impl Iterator<Item = f64> {
    let rows = motions.iter().flat_map(|motion| motion.rows());
    let all = rows.flat_map(|row| columns().map(|column| (column.value)(row)));
    all.filter(|value| *value != 0.0)
}

/// Whether most numbers in this `unit` are those of single precision. Places that the task gives, at the beginning and in
/// motions that it prescribes, are not.
fn is_single(motions: &[&Motion], unit: &str) -> bool {
    let (mut single, mut double) = (0, 0);
    for row in motions.iter().flat_map(|motion| motion.rows()) {
        for column in columns().filter(|column| column.unit == unit) {
            let value = (column.value)(row);
            match is_of_32_bits(value) {
                // A short number survives in any case.
                true => single += usize::from(value != 0.0 && decimal(value).0 > TELLING_DIGITS),
                false => double += 1,
            }
        }
    }
    single >= TELLING && single >= double
}

#[cfg(test)]
mod tests {
    use super::super::convergence::converged;
    use super::super::experiments;
    use super::*;
    use crate::code::{Code, Declaration};
    use crate::dem::run_contact_test;
    use crate::model::{ContactConvention, ContactTest, CoulombOperand, HistoryUpdate, Law};
    use crate::model::{SlidingSpring, TensileForce};
    use rayon::prelude::*;

    /// The properties of the native code under a convention, if every number that it reports is `rounded`.
    fn properties(convention: ContactConvention, rounded: impl Fn(f64) -> f64) -> Vec<Property> {
        let declared = Declaration {
            convention,
            in_space: false,
            ..Code::native().declaration()
        };
        let run = |tests: &[ContactTest]| {
            let motions = tests.iter().map(|test| {
                let motion = run_contact_test(test).expect("it is finite");
                with_numbers(&motion, |_, value| rounded(value))
            });
            Ok::<_, ()>(motions.collect())
        };
        converged(&declared, run, |_| false).expect("every test is answered")
    }

    fn conventions() -> [ContactConvention; 4] {
        let turning = ContactConvention::TURNING;
        [
            turning,
            ContactConvention::PAPER,
            ContactConvention {
                coulomb_operand: CoulombOperand::Spring,
                sliding_spring: SlidingSpring::FollowsLimit,
                history_update: HistoryUpdate::Projected,
                tensile_force: TensileForce::NeverPulls,
                ..turning
            },
            ContactConvention::with_law(Law::HERTZ),
        ]
    }

    /// What lies outside of two uncertainties: name, deviation and uncertainty.
    fn outside(exact: &[Property], found: &[Property]) -> Vec<(String, f64, f64)> {
        let off = exact.iter().filter_map(|own| {
            let other = found.iter().find(|other| other.name == own.name)?;
            let off = (other.measured.value - own.measured.value).abs();
            let open = other.measured.uncertainty + own.measured.uncertainty;
            (off > 2.0 * open).then(|| (own.name.clone(), off, open))
        });
        off.collect()
    }

    #[test]
    fn printed_digits_leave_the_truth_within_two_uncertainties() {
        type Print = Box<dyn Fn(f64) -> f64 + Sync>;
        let read = |text: String| text.parse().expect("a number");
        let significant = (5..=16).map(|digits: usize| {
            let print: Print = Box::new(move |value| read(format!("{value:.*e}", digits - 1)));
            (format!("{digits} digits"), print)
        });
        let fixed = [6_usize, 9].map(|decimals| {
            let print: Print = Box::new(move |value| read(format!("{value:.decimals$}")));
            (format!("{decimals} decimals"), print)
        });
        let single: Print = Box::new(|value| f64::from(value as f32));
        let ways: Vec<(String, Print)> = significant
            .chain(fixed)
            .chain([("single precision".to_owned(), single)])
            .collect();
        let exact = conventions().map(|convention| properties(convention, |value| value));
        let places = 0..exact.len() * ways.len();
        let told = places.into_par_iter().flat_map_iter(|place| {
            let (of_convention, of_way) = (place / ways.len(), place % ways.len());
            let convention = conventions()[of_convention];
            let (way, print) = &ways[of_way];
            let outside = outside(&exact[of_convention], &properties(convention, print));
            let told = outside
                .into_iter()
                .map(move |one| format!("{way}, {:?}: {one:?}", convention.history_update));
            told.collect::<Vec<_>>()
        });
        let told: Vec<String> = told.collect();
        assert!(told.is_empty(), "{}", told.join("\n"));
    }

    #[test]
    fn single_precision_is_seen_in_each_quantity() {
        let tests =
            experiments::common(experiments::ContactKind::Pair, &ContactConvention::TURNING);
        let motions = |is_kept: fn(&Column<MotionRow>) -> bool| -> Vec<Motion> {
            let each = tests.iter().map(|test| {
                let motion = run_contact_test(test).expect("it is finite");
                with_numbers(&motion, |column, value| match is_kept(column) {
                    true => f64::from(value as f32),
                    false => value,
                })
            });
            each.collect()
        };
        let of = |is_kept| {
            let motions = motions(is_kept);
            Rounding::of(&motions.iter().collect::<Vec<_>>()).single_quantities()
        };
        assert_eq!(of(|_| false), Vec::<&str>::new());
        assert_eq!(
            of(|column| column.unit.starts_with("k_n")),
            ["forces", "torques"]
        );
        assert_eq!(
            of(|_| true),
            ["positions", "velocities", "spins", "forces", "torques"]
        );
    }

    #[test]
    fn more_digits_are_known_better_and_all_of_them_as_before() {
        let of = |digits: usize| {
            let print = |value: f64| {
                format!("{value:.*e}", digits - 1)
                    .parse()
                    .expect("a number")
            };
            let found = properties(ContactConvention::TURNING, print);
            let damping = found.iter().find(|own| own.name == "pair_normal_damping");
            damping.expect("it is measured").measured.uncertainty
        };
        let known: Vec<f64> = [6, 9, 12, 17].map(of).to_vec();
        assert!(known.is_sorted_by(|more, less| more > less), "{known:?}");
        assert!(known[0] < 1e-3 && known[3] < 1e-12, "{known:?}");
    }
}
