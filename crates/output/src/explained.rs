//! The explanation of one row for programs: the same steps as for people, in tables.

use super::number::significant;
use super::table::{Columns, DataTable};
use super::{budget, crosscheck};
use crate::model::{Case, Preparation};
use crate::runs::RunSummary;
use crate::series::MechanicalLaw;
use crate::study::yield_force::{Evidence, Judgement, TwinForce};

/// A judgement, the same force from runs with more digits, and what the identity of an installed code covers.
type Row<'a> = (
    &'a Judgement,
    Option<&'a Result<TwinForce, String>>,
    Option<&'a str>,
);

/// Says where the arms come from under which the reference of `row` was computed.
pub(super) fn origin_of_arms(row: &Judgement) -> &'static str {
    match row.arms_are_measured {
        _ if row.study.convention_uncertainty.is_some() => "measured, not declared",
        true => "measured",
        false => "declared",
    }
}

/// Returns the tables of the row itself, its error budget, its runs, and what else supports its verdict.
pub fn explained<'a>(
    row: &'a Judgement,
    twin: Option<&'a Result<TwinForce, String>>,
    coverage: Option<&'a str>,
) -> [DataTable<'a>; 4] {
    let own = std::slice::from_ref(row);
    [
        crosscheck(own),
        budget(own),
        explained_runs(own),
        grounds([(row, twin, coverage)]),
    ]
}

/// Returns the last two tables of `explained`, without rows.
pub fn declared_explanations() -> [DataTable<'static>; 2] {
    [explained_runs(&[]), grounds([])]
}

/// Returns the table of the runs behind the rows.
pub(super) fn explained_runs(judgements: &[Judgement]) -> DataTable<'_> {
    let cases = judgements
        .iter()
        .flat_map(|row| row.study.cases.iter().zip(row.runs()).enumerate());
    let mut columns = Columns::<(usize, (&Case, &RunSummary))>::new(
        "explained_runs",
        "A row is one of the runs behind a row of `crosscheck`.",
        "`tristack crosscheck --explain --format json`",
    )
    .right("run", |(index, _)| (index + 1).to_string())
    .number("wall_speed", "r √(k_n/m)", |(_, (case, _))| {
        case.protocol.wall_speed
    })
    .means("speed of the top wall")
    .shown_as("wall speed", |speed| format!("{speed:.3e}"))
    .number("time_step", "√(m/k_n)", |(_, (case, _))| {
        case.protocol.time_step
    })
    .means("time step")
    .shown("time step")
    .number("ramp_time", "√(m/k_n)", |(_, (case, _))| {
        match case.protocol.preparation {
            Preparation::GravityRamp { ramp_time, .. } => Some(ramp_time),
            Preparation::SideWalls(_) | Preparation::Rigid => None,
        }
    })
    .means("duration of the gravity ramp; absent between side walls")
    .shown("ramp")
    .number("steps", "1", |(_, (case, _))| case.total_steps())
    .means("steps in all")
    .shown("steps")
    .number("slip_onset", "m g", |(_, (_, run))| {
        Some(run.estimates.slip?.force)
    })
    .means("F at which the floor begins to slip in this run")
    .shown_as("slip onset", |force| significant(force, 11))
    .number("peak_force", "m g", |(_, (_, run))| {
        Some(run.estimates.peak?.force)
    })
    .means("the largest F in this run")
    .shown_as("peak", |force| significant(force, 11))
    .number("sampling", "m g", |(_, (_, run))| {
        Some(run.estimates.slip?.sampling)
    })
    .means("distance between the interpolations of two orders at the slip onset")
    .shown_as("sampling", |distance| format!("{distance:.0e}"))
    .number("amplification", "1", |(_, (_, run))| {
        Some(run.estimates.slip?.sensitivity)
    })
    .means("factor by which an error of the recorded forces is amplified in the slip onset")
    .shown_as("amplified", |factor| format!("{factor:.0} x"));
    for law in MechanicalLaw::ALL {
        let (name, meaning) = named(law);
        columns = columns
            .number(name, "1", move |(_, (_, run))| {
                let deviation = run.mechanics.as_ref()?.0.get(&law)?;
                Some(deviation.size / deviation.bound)
            })
            .means(meaning);
    }
    columns.rows(cases)
}

/// Returns name and meaning of the column with the deviation of a run from a law of mechanics.
fn named(law: MechanicalLaw) -> (&'static str, &'static str) {
    match law {
        MechanicalLaw::ForceBalance => (
            "force_balance",
            "largest deviation from the balance of forces, in units of the allowed one; absent where it is not tested",
        ),
        MechanicalLaw::MirrorSymmetry => (
            "mirror_symmetry",
            "the same for the mirror symmetry of the stack",
        ),
        MechanicalLaw::WallOverlap => (
            "wall_overlap",
            "the same for the wall force against the overlap of cylinder 1 with the wall",
        ),
        MechanicalLaw::FloorOverlap => (
            "floor_overlap",
            "the same for the floor force against the overlap with the floor",
        ),
    }
}

fn grounds<'a>(rows: impl IntoIterator<Item = Row<'a>>) -> DataTable<'a> {
    Columns::<Row>::new(
        "explanation",
        "A row is what stands behind the verdict on one row of `crosscheck`, beside its runs and its budget.",
        "`tristack crosscheck --explain --format json`",
    )
    .code(|(row, ..)| &row.code)
    .text("arms", |(row, ..)| origin_of_arms(row))
    .means("where the arms of the reference come from: `declared`, `measured` as declared, or `measured, not declared`")
    .number("first_order", "m g", |(row, ..)| {
        Some(row.slip()?.first_order)
    })
    .means("slip onset at vanishing wall speed by the straight line through the two slower runs")
    .text("twin_version", |(_, twin, _)| {
        Some((*twin)?.as_ref().ok()?.version.clone())
    })
    .means("the build of the code with more digits, if there is one here")
    .number("twin_force", "m g", |(_, twin, _)| {
        Some((*twin)?.as_ref().ok()?.force)
    })
    .means("the slip onset at vanishing wall speed by that build")
    .text("twin_error", |(_, twin, _)| (*twin)?.as_ref().err().cloned())
    .means("why that build gives none")
    .text("evidence", |(row, ..)| Evidence::of(row).as_str())
    .means("the strongest evidence of the row")
    .text("does_not_prove", |(row, ..)| {
        Evidence::of(row).does_not_prove()
    })
    .means("what that evidence does not prove")
    .cause(|(row, ..)| row.grounds.cause())
    .text("notes", |(row, ..)| row.notes().join("; "))
    .means("notes on the verdict")
    .text("identity", |(.., coverage)| {
        coverage.map(str::to_owned)
    })
    .means("what must not have changed for a run to be taken from the store; absent for recorded runs")
    .rows(rows)
}
