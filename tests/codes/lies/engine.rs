//! Engines with the conventions of the codes, honest or not, and the verdict on them.

use super::lie::{Kind, Lie, LyingLaw};
use tristack::code::{Code, Identity, Provenance, Run, SettledCode};
use tristack::dem::{SpringDashpot, compress_stack_with};
use tristack::model::{CRITICAL_FRICTION, Case, ContactConvention, Stack};
use tristack::runs::RunSummary;
use tristack::series::Series;
use tristack::study::yield_force::{Measurement, plan};
use tristack::study::{Study, Verdict};

/// A measurement that an honest engine passes.
pub struct Honest {
    pub measurement: Measurement,
    /// Largest error that agrees, relative to F + 3.
    pub tolerance: f64,
}

/// What a row says.
pub struct Said {
    pub verdict: Verdict,
    pub notes: Vec<String>,
    pub tolerance: Option<f64>,
    /// Whether the yield force itself is further off than the tolerance.
    pub is_off: bool,
}

/// The stacks at which engines lie: below, at and above the critical friction.
pub const STACKS: [(f64, f64); 3] = [(0.2, 1e3), (CRITICAL_FRICTION, 1e4), (0.3, 1e2)];

impl Honest {
    /// The conventions of native, LIGGGHTS, YADE's plane floor and LAMMPS, at every stack.
    pub fn all() -> Vec<Self> {
        let names = ["native", "liggghts", "yade-wall", "lammps"];
        let codes = names.map(|name| {
            let code = Code::named(name).expect("it is built in");
            code.as_declared().expect("nothing is left out")
        });
        let all = STACKS.iter().flat_map(|&(friction, stiffness)| {
            codes
                .each_ref()
                .map(|code| Self::new(code, &Stack::paper(friction, stiffness)))
        });
        all.collect()
    }

    pub fn new(code: &SettledCode, stack: &Stack) -> Self {
        Self::with(code, stack, code.convention())
    }

    /// The same with any convention.
    pub fn with(code: &SettledCode, stack: &Stack, convention: ContactConvention) -> Self {
        let mut honest = Self {
            measurement: plan(code, stack, convention),
            tolerance: f64::NAN,
        };
        let said = honest.judge(&Lie::none());
        honest.tolerance = said.tolerance.unwrap_or(f64::NAN);
        honest
    }

    pub fn label(&self) -> String {
        let stack = &self.measurement.stack;
        format!(
            "{}, mu {}, stiffness {}",
            self.measurement.code.name(),
            stack.floor_friction,
            stack.stiffness
        )
    }

    /// The row of an engine that tells `lie` in every run.
    pub fn judge(&self, lie: &Lie) -> Said {
        self.judge_runs(self.runs(lie))
    }

    /// The runs of an engine that tells `lie` in each of them.
    pub fn runs(&self, lie: &Lie) -> Vec<Run> {
        let cases = self.measurement.cases.iter();
        cases.map(|case| self.run(case, lie)).collect()
    }

    /// The row of `runs`, if the columns `absent` are not reported.
    pub fn judge_without(&self, absent: &[&str], mut runs: Vec<Run>) -> Said {
        for run in &mut runs {
            run.series = without(&run.series, absent, &run.case);
        }
        self.judge_runs(runs)
    }

    fn judge_runs(&self, runs: Vec<Run>) -> Said {
        let runs = runs.into_iter().map(RunSummary::new);
        let evaluation = self.measurement.evaluate(vec![runs.collect()]);
        let grounds = evaluation.grounds;
        Said {
            verdict: grounds.verdict(),
            notes: grounds.notes().into_iter().map(str::to_owned).collect(),
            is_off: grounds
                .deviation()
                .is_some_and(|(error, tolerance)| error.abs() > tolerance),
            tolerance: grounds.deviation().map(|(_, tolerance)| tolerance),
        }
    }

    fn run(&self, case: &Case, lie: &Lie) -> Run {
        let limit = &self.measurement.limit;
        let computed = lie.computed(case, limit.pair_friction.expect("it yields"));
        let law = SpringDashpot::like(0.0, &computed.convention, computed.stack.stiffness_ratio);
        let model = LyingLaw {
            law,
            lie: *lie,
            slow: match lie.kind {
                // The floor slides this fast near the peak.
                Kind::FrictionUntilThePeak => 20.0 * case.protocol.wall_speed,
                _ => 0.5 * case.protocol.wall_speed,
            },
        };
        let series = compress_stack_with(&computed, model, || true).expect("a finite series");
        let mut rows = series.samples().to_vec();
        for row in &mut rows {
            row.time = row.step as f64 * case.protocol.time_step;
        }
        let load = (limit.yield_force.expect("it yields") + 3.0) * case.stack.epsilon();
        lie.write(&mut rows, load);
        Run {
            case: *case,
            series: Series::new(rows, case).expect("rows at their steps"),
            provenance: Provenance::now(
                Identity {
                    code: self.measurement.code.name().to_string(),
                    version: "lying".to_owned(),
                    package: None,
                    program_hash: None,
                    files_hash: None,
                    witness: None,
                },
                String::new(),
                Vec::new(),
                case.total_steps(),
                0.0,
            ),
        }
    }
}

/// `series` as a code writes it that does not report the columns `absent`.
fn without(series: &Series, absent: &[&str], case: &Case) -> Series {
    let text = String::from_utf8(series.to_csv()).expect("text");
    let names = Series::COLUMNS.iter().enumerate();
    let kept: Vec<usize> = names
        .filter(|(_, name)| !absent.contains(name))
        .map(|(place, _)| place)
        .collect();
    let lines = text.lines().map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        let kept: Vec<&str> = kept.iter().map(|place| fields[*place]).collect();
        kept.join(",") + "\n"
    });
    let text: String = lines.collect();
    let series = Series::read(text.as_bytes(), case).expect("a series without them");
    assert_eq!(series.absent(), absent);
    series
}
