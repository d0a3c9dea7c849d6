//! The data against which the paper's statements on its simulations are checked: native runs, or what the authors
//! have published.

use super::notation::{number, scientific};
use crate::code::Code;
use crate::model::Stack;
use crate::published::Published;
use crate::reproduction::{FITTED_FROM, ForceSeries, Reproduction, slope};
use crate::study::yield_force::{Judgement, PAPER_TIME_STEP, PAPER_WALL_SPEED};

/// Yield forces and a series of the wall force, from native runs or from the published data.
pub(crate) struct Simulations {
    /// Who made them, as the beginning of evidence.
    pub who: &'static str,
    /// How the yield forces were read, with a leading comma.
    pub read: &'static str,
    /// Fig. 2(a): floor friction, stiffness and F.
    pub over_friction: Vec<[f64; 3]>,
    /// Fig. 2(b): the same.
    pub over_stiffness: Vec<[f64; 3]>,
    /// Exponents of Fig. 2(b).
    pub exponents: Vec<FittedExponent>,
    /// Wall speeds, as they are labelled, and (F − limit)/limit.
    pub wall_speeds: Vec<(f64, f64)>,
    /// Time steps, as they are labelled, and F.
    pub time_steps: Vec<(f64, f64)>,
    /// f(t).
    pub series: ForceSeries,
    /// Where the peak of f(t) stands, if not in its rows, with a leading space.
    pub peak_source: String,
    /// Whether speeds and time steps are only labels: the program that made them has the units √(g r) and √(r/g).
    labelled: bool,
}

/// The slope of ln(F + 3) over ln(k_n r/(m g)) from 10³ on.
pub(crate) struct FittedExponent {
    /// Floor friction.
    pub friction: f64,
    /// The slope.
    pub exponent: f64,
    /// The slope of the exact limit over the same stiffnesses.
    pub exact: f64,
    /// Uncertainty that follows from those of the forces, where they are known.
    pub uncertainty: Option<f64>,
}

impl Simulations {
    /// Takes the native runs of a reproduction.
    pub fn native(runs: &Reproduction) -> Self {
        let native = |code: &Code| code.is_native();
        let exponents = runs.exponents.iter().filter(|own| native(&own.code));
        let speeds = runs.convergence.wall_speeds.iter();
        let speeds = speeds.filter(|own| native(&own.code));
        let steps = runs.convergence.time_steps.iter();
        let steps = steps.filter(|own| native(&own.code));
        Self {
            who: "native DEM",
            read: ", wall speed extrapolated to 0",
            over_friction: forces(&runs.yield_curves),
            over_stiffness: forces(&runs.scaling),
            exponents: exponents
                .map(|own| FittedExponent {
                    friction: own.mu,
                    exponent: own.exponent,
                    exact: own.exact,
                    uncertainty: Some(own.uncertainty),
                })
                .collect(),
            wall_speeds: speeds
                .filter_map(|own| Some((own.wall_speed, own.excess_of_peak()?)))
                .collect(),
            time_steps: steps
                .filter_map(|own| Some((own.time_step, own.peak_force?)))
                .collect(),
            series: runs.force_series.clone(),
            peak_source: String::new(),
            labelled: false,
        }
    }

    /// Takes the data that the authors have published.
    pub fn published(published: &Published) -> Self {
        let forces = |figure| -> Vec<[f64; 3]> {
            let own = published.of_figure(figure);
            own.map(|own| {
                let stack = &own.stack;
                [stack.floor_friction, stack.stiffness, own.value.value]
            })
            .collect()
        };
        let over_stiffness = forces("fig2b");
        let mut frictions: Vec<f64> = over_stiffness.iter().map(|row| row[0]).collect();
        frictions.sort_by(f64::total_cmp);
        frictions.dedup();
        let exponents = frictions.into_iter().map(|friction| {
            let own = published.of_figure("fig2b").filter(|own| {
                own.stack.floor_friction == friction && own.stack.stiffness >= FITTED_FROM
            });
            let points = own.filter_map(|own| {
                let stiffness = own.stack.stiffness;
                Some(((stiffness, own.load()), (stiffness, own.limit? + 3.0)))
            });
            let (points, limits): (Vec<_>, Vec<_>) = points.unzip();
            FittedExponent {
                friction,
                exponent: slope(&points),
                exact: slope(&limits),
                uncertainty: None,
            }
        });
        let excess = |force: f64, limit: Option<f64>| limit.map(|limit| force / limit - 1.0);
        let speeds = published.of_figure("figS3b");
        let (series, peak_source) = series(published);
        Self {
            who: "the published data",
            read: "",
            exponents: exponents.collect(),
            over_friction: forces("fig2a"),
            over_stiffness,
            wall_speeds: speeds
                .filter_map(|own| Some((own.labelled[0], excess(own.value.value, own.limit)?)))
                .collect(),
            time_steps: published
                .of_figure("figS3a")
                .map(|own| (own.labelled[1], own.value.value))
                .collect(),
            series,
            peak_source,
            labelled: true,
        }
    }

    /// Explains the settings of runs of a stack if they are labels, with a leading semicolon.
    pub fn labels(&self, stack: &Stack) -> String {
        if !self.labelled {
            return String::new();
        }
        format!(
            "; settings as labelled: with the units of the program the speed is ${0}$ times smaller, the time step ${0}$ times larger",
            number(stack.stiffness.sqrt())
        )
    }
}

/// Returns the first published series and says where its peak stands: the rows lie so far apart that they miss it,
/// but Fig. 2(a) has a force of the same stack. Without a published series there are no rows.
fn series(published: &Published) -> (ForceSeries, String) {
    let own = published.series.first().map(|own| &own.published);
    let rows = own.map_or(&[][..], |own| &own.rows);
    let rows: Vec<(f64, f64)> = rows
        .iter()
        .map(|(_, [time, force])| (time.value, force.value))
        .collect();
    let highest = rows.iter().map(|row| row.1).reduce(f64::max);
    let mut forces = published.of_figure("fig2a");
    let force = forces.find(|force| own.is_some_and(|own| own.stack == force.stack));
    let gaps = rows.windows(2).filter(|pair| Some(pair[1].1) == highest);
    let gap = gaps.map(|pair| pair[1].1 - pair[0].1).next();
    let source = force.zip(gap).map(|(force, gap)| {
        format!(
            " ({} line {}; the rows of $f(t)$ are ${}mg$ apart there)",
            force.file.replace("/data/", ": "),
            force.line,
            scientific(gap, 0)
        )
    });
    let series = ForceSeries {
        rows,
        slip_force: None,
        peak_force: force.map(|force| force.value.value).or(highest),
        limit: own.and_then(|own| own.limit),
        wall_speed: PAPER_WALL_SPEED,
        time_step: PAPER_TIME_STEP,
    };
    (series, source.unwrap_or_default())
}

/// Returns friction, stiffness and yield force of the native rows that have one.
fn forces(judgements: &[Judgement]) -> Vec<[f64; 3]> {
    let native = judgements.iter().filter(|row| row.code.is_native());
    let forces = native.filter_map(|row| Some([row.mu(), row.stiffness(), row.yield_force()?]));
    forces.collect()
}
