//! What the paper's statements on its simulations are checked with: native runs, or the data that the authors have published.

use crate::code::Code;
use crate::paper::published::Published;
use crate::paper::reproduction::{FITTED_FROM, ForceSeries, Reproduction, slope};
use crate::study::yield_force::{Judgement, PAPER_TIME_STEP, PAPER_WALL_SPEED};

/// Yield forces and a series of the wall force, by whoever made them.
pub(crate) struct Simulations {
    /// Who, at the beginning of evidence.
    pub who: &'static str,
    /// How the yield forces were read, with a comma before it.
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
}

/// The slope of ln(F + 3) over ln(k_n r/(m g)) from 10³ on.
pub(crate) struct FittedExponent {
    /// Floor friction.
    pub friction: f64,
    /// The slope.
    pub exponent: f64,
    /// What the uncertainties of the forces can do to it, where they are known.
    pub uncertainty: Option<f64>,
}

impl Simulations {
    /// The native runs of a reproduction.
    pub fn native(runs: &Reproduction) -> Self {
        let native = |code: &Code| *code == Code::NATIVE;
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
        }
    }

    /// The data that the authors have published.
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
        frictions.dedup();
        let exponents = frictions.into_iter().map(|friction| {
            let own = over_stiffness.iter();
            let own = own.filter(|row| row[0] == friction && row[1] >= FITTED_FROM);
            let points: Vec<(f64, f64)> = own.map(|row| (row[1], row[2] + 3.0)).collect();
            FittedExponent {
                friction,
                exponent: slope(&points),
                uncertainty: None,
            }
        });
        let excess = |force: f64, limit: Option<f64>| limit.map(|limit| force / limit - 1.0);
        let speeds = published.of_figure("figS3b");
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
            series: series(published),
        }
    }
}

/// The first of the published series; without rows where there is none.
fn series(published: &Published) -> ForceSeries {
    let own = published.series.first().map(|own| &own.published);
    let rows = own.map_or(&[][..], |own| &own.rows);
    let rows: Vec<(f64, f64)> = rows
        .iter()
        .map(|(_, [time, force])| (time.value, force.value))
        .collect();
    let peak = rows.iter().map(|row| row.1).reduce(f64::max);
    ForceSeries {
        rows,
        slip_force: None,
        peak_force: peak,
        limit: own.and_then(|own| own.limit),
        wall_speed: PAPER_WALL_SPEED,
        time_step: PAPER_TIME_STEP,
    }
}

/// Friction, stiffness and yield force of the native rows that have one.
fn forces(judgements: &[Judgement]) -> Vec<[f64; 3]> {
    let native = judgements.iter().filter(|row| row.code == Code::NATIVE);
    let forces = native.filter_map(|row| Some([row.mu(), row.stiffness(), row.yield_force()?]));
    forces.collect()
}
