//! Columns that hold a function of the right values: changes, sums, means or absolute values.

use super::written::Written;

/// Number of decimals from which rounding is too small to be found.
const MOST_DECIMALS: i32 = 9;

impl Written<'_> {
    /// Says which function of the right values a column holds: a change, sum, mean, absolute value or the like.
    pub(super) fn transformed(&self, column: usize) -> Option<String> {
        let steps: Vec<f64> = self
            .own
            .found
            .iter()
            .map(|(step, _)| *step as f64)
            .collect();
        let row = |step: f64| steps.partition_point(|own| *own < step);
        let before = |step: f64| row(step).checked_sub(1).map(|row| steps[row]);
        let own = |step: f64| self.right(column, step);
        let start = own(0.0);
        let sum = |step: f64| {
            steps[..=row(step)]
                .iter()
                .map(|step| own(*step))
                .sum::<f64>()
        };
        let whole = |step: f64| (0..=step as u64).map(|step| own(step as f64)).sum::<f64>();
        let mean = |step: f64| {
            let from = before(step).map_or(step, |before| before + 1.0) as u64;
            (from..=step as u64)
                .map(|step| own(step as f64))
                .sum::<f64>()
                / (step as u64 + 1 - from) as f64
        };
        let turned = 2.0 * std::f64::consts::PI;
        let last = steps.len() - 1;
        let initial = initial_position(self.own.columns[column].name);
        let values: [(&str, &dyn Fn(f64) -> f64); 20] = [
            (
                "are written without their signs: their absolute values",
                &|step| own(step).abs(),
            ),
            ("are 0 where they must be negative", &|step| {
                own(step).max(0.0)
            }),
            ("are 0 where they must be positive", &|step| {
                own(step).min(0.0)
            }),
            (
                "are cut off after the decimal point, whole numbers",
                &|step| own(step).trunc(),
            ),
            (
                "are displacements since the beginning of the run, in place of positions",
                &|step| own(step) - initial,
            ),
            (
                "are changes since the beginning of the compression, in place of values",
                &|step| own(step) - start,
            ),
            (
                "are negative changes since the beginning of the compression, in place of values",
                &|step| start - own(step),
            ),
            (
                "are changes since the row before, in place of values",
                &|step| own(step) - before(step).map_or(0.0, own),
            ),
            (
                "are changes since the row before, which are 0 in the first one",
                &|step| own(step) - before(step).map_or(own(step), own),
            ),
            ("are changes since the step before", &|step| {
                own(step) - own(step - 1.0)
            }),
            ("are sums over all rows so far (cumulative)", &sum),
            ("are sums over all steps so far (cumulative)", &whole),
            (
                "are sums over all steps so far times the time step: an integral over time",
                &|step| whole(step) * self.time_step,
            ),
            (
                "are averages over the steps since the row before; a row is one moment",
                &mean,
            ),
            ("are means of this step and the one before", &|step| {
                0.5 * (own(step) + own(step - 1.0))
            }),
            ("are the largest values so far", &|step| {
                (0..=step as u64)
                    .map(|step| own(step as f64))
                    .fold(f64::NEG_INFINITY, f64::max)
            }),
            (
                "are wrapped into 0 to 2 pi (one turn), and must be negative where they count clockwise",
                &|step| own(step).rem_euclid(turned),
            ),
            ("stand in the reverse order of the rows", &|step| {
                own(steps[last - row(step)])
            }),
            ("are those of the row before", &|step| {
                before(step).map_or(0.0, own)
            }),
            (
                "are those of the first row throughout: written once, or kept from the start",
                &|_| start,
            ),
        ];
        let known = values.into_iter().find_map(|(text, value)| {
            let factor = self.factor(column, value).filter(|factor| *factor != 0.0)?;
            Some(if (factor - 1.0).abs() < 1e-6 {
                text.to_owned()
            } else {
                format!("{text}, times {factor:.6}")
            })
        });
        let squared = || {
            let factor = self.factor(column, &|step| own(step).powi(2))?;
            Some(format!("are squares, times {factor:.6}"))
        };
        let rounded = || {
            let decimals = (0..MOST_DECIMALS).find(|decimals| {
                let unit = libm::exp10(f64::from(*decimals));
                self.explains(column, &|step| (own(step) * unit).round() / unit)
            })?;
            Some(format!("are rounded to {decimals} decimals"))
        };
        known
            .or_else(squared)
            .or_else(rounded)
            .or_else(|| self.smoothed(column, &steps))
    }

    /// Detects exponential smoothing: a fixed fraction of the right value, and the rest of the row before.
    fn smoothed(&self, column: usize, steps: &[f64]) -> Option<String> {
        let found = |row: usize| self.own.found[row].1[column];
        let share = |row: usize| {
            let change = self.right(column, steps[row]) - found(row - 1);
            (found(row) - found(row - 1)) / change
        };
        let middle = (steps.len() / 2).max(1);
        let own = share(middle);
        let is_one = |row: usize| {
            let told = found(row - 1) + own * (self.right(column, steps[row]) - found(row - 1));
            (told - found(row)).abs() <= self.own.allowed() * self.own.columns[column].scale
        };
        (own > 0.0 && own < 1.0 && (1..steps.len()).all(is_one)).then(|| {
            format!(
                "are smoothed: {own:.6} of the right value and the rest of the row before; a row is one moment"
            )
        })
    }
}

/// Returns the initial coordinate that belongs to a column of positions; NaN for other columns.
fn initial_position(column: &str) -> f64 {
    match column {
        "x1" => 0.0,
        "y1" => 1.0 + 3f64.sqrt(),
        "x2" | "y2" | "y3" => 1.0,
        "x3" => -1.0,
        _ => f64::NAN,
    }
}
