//! Impacts by the codes, compared with their exact values.

use super::number::{digits, one_digit, relative, rounded};
use super::table::{Columns, DataTable};
use super::text::{markdown_code, markdown_notes};
use crate::study::impact::{DIVISIONS, ImpactFinding, ImpactJudgement, NEARLY_ELASTIC};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE};

/// Returns the table of impacts, one row per number of an impact.
pub fn impacts(judgements: &[ImpactJudgement]) -> DataTable<'_> {
    fn measured<'a>(row: &&'a ImpactJudgement) -> Option<&'a ImpactFinding> {
        row.finding.as_ref()?.as_ref()
    }
    type Row<'a> = &'a ImpactJudgement;
    let uncertainty = |row: &Row| Some(measured(row)?.budget.total());
    Columns::<Row>::new(
        "impacts",
        "A row is one number of one impact of two cylinders, or of a cylinder on the floor, extrapolated to vanishing \
         time step, beside its exact value under the contact convention of the code.",
        "`tristack impacts` (impacts.csv, impacts.json)",
    )
    .code(|row| &row.code)
    .version(|row| &row.version)
    .source(|row| row.source)
    .convention(|row| Some(row.study.impact.convention.into()))
    .law(|row| Some(row.study.impact.convention.law))
    .number("kappa", "1", |row| row.study.impact.stiffness_ratio)
    .means("stiffness ratio κ = k_n/k_t of pairs")
    .number("moment_of_inertia", "m r²", |row| {
        row.study.impact.convention.moment_of_inertia
    })
    .means("moment of inertia: 0.5 of cylinders, 0.4 of spheres")
    .text("target", |row| row.study.impact.target.as_str())
    .means("`pair` if two cylinders strike one another, `floor` if one strikes the floor")
    .shown("target")
    .number("speed", "r √(k_n/m)", |row| row.study.impact.approach_speed)
    .means("speed of approach")
    .shown_as("speed", rounded)
    .number("sliding_speed", "r √(k_n/m)", |row| {
        row.study.impact.sliding_speed
    })
    .means("speed at which the surfaces slide before the impact: along the floor, or by two equal spins; 0 head-on")
    .shown_as("sliding", rounded)
    .number("mu", "1", |row| row.study.impact.friction)
    .means("friction coefficient")
    .number("declared_restitution", "1", |row| {
        row.study.impact.convention.restitution
    })
    .means(
        "restitution e_r of the task, which sets the damping: that of a single cylinder of mass m whose contact may pull and \
         has one damping ratio at every overlap",
    )
    .shown_as("e_r", rounded)
    .text("quantity", |row| row.study.quantity.as_str())
    .means(
        "`greatest-overlap` in r, `duration` of the overlap in √(m/k_n), `restitution`, change of the \
         `tangential-velocity` in r √(k_n/m), change of the `spin` in √(k_n/m)",
    )
    .shown("quantity")
    .text("reference", |row| row.study.reference().as_str())
    .means(
        "`closed-form`; `integrated`: the equations of motion, integrated; `twin`: the native code with the \
         same convention, run by run",
    )
    .shown("reference")
    .dispensable(1)
    .number("exact", "1", |row| {
        let found = measured(row).map(|own| own.exact);
        found.filter(|_| row.grounds.is_judged())
    })
    .means("exact value under the convention of the code, in the unit of the quantity")
    .shown_as("exact", digits::<8>)
    .dispensable(4)
    .number("measured", "1", |row| Some(measured(row)?.measured))
    .means("the same as measured, extrapolated to vanishing time step")
    .shown_as("measured", digits::<8>)
    .dispensable(5)
    .number("error", "1", |row| Some(row.judged()?.error))
    .means("measured minus exact, over exact; beside a twin the differences at equal time steps, extrapolated")
    .shown_as("error", relative)
    .dispensable(6)
    .number("uncertainty", "1", uncertainty)
    .means("sum of the following parts")
    .shown_as("±", one_digit)
    .dispensable(3)
    .number("time_step", "1", |row| Some(measured(row)?.budget.time_step))
    .means("change by the last order in the time step that the extrapolation removes")
    .number("sign_change", "1", |row| {
        Some(measured(row)?.budget.sign_change)
    })
    .means("kink of the limit μ |N| where a normal force begins to pull, which lies anywhere in a step")
    .number("round_off", "1", |row| Some(measured(row)?.budget.round_off))
    .means("rounding of positions and velocities in every step, a random walk")
    .number("print_precision", "1", |row| {
        Some(measured(row)?.budget.print_precision)
    })
    .means("half a unit in the last printed place")
    .number("convention", "1", |row| Some(measured(row)?.budget.convention))
    .means("uncertainty of the exact value where inertia or arm were measured, not declared")
    .number("tolerance", "1", |row| row.tolerance())
    .means("largest error that agrees")
    .shown_as("tolerance", one_digit)
    .dispensable(2)
    .cause(|row| row.grounds.cause())
    .verdict(|row| row.verdict())
    .rows(judgements)
}

/// Formats the rows for a terminal.
pub fn impacts_text(judgements: &[ImpactJudgement]) -> String {
    impacts(judgements).shown().terminal()
}

/// Formats a page with the rows, their meaning, and their notes.
pub fn impacts_markdown(judgements: &[ImpactJudgement], command: &str) -> String {
    let (version, command) = (env!("CARGO_PKG_VERSION"), markdown_code(command));
    let divisions = DIVISIONS.map(|division| division.to_string()).join(", ");
    let mut page = format!(
        "# Impacts\n\nMade by tristack {version} with {command}.\n\n\
         Two cylinders strike one another, or one strikes the floor, without gravity: the tests of Chung and Ooi \
         (doi 10.1007/s10035-011-0277-0) in their exact parts (docs/theory.md, section 12). Spheres and cylinders differ in \
         them by the moment of inertia alone.\n\n\
         Each impact is carried out at four time steps, of which {divisions} make the exact time for which the \
         force acts, and each number is extrapolated to none. Errors and uncertainties are relative to the exact value. \
         The tolerance is the uncertainty, but at least {MIN_TOLERANCE:e} and at most {MAX_TOLERANCE:e}. Codes that refuse \
         the restitution 1 are given 1 - {:.0e} in its place.\n\n\
         The declared restitution e_r is that of a cylinder of mass m whose contact may pull and has one damping ratio at every \
         overlap; a pair has half of that as its effective mass and the same damping, hence another restitution.\n\n",
        1.0 - NEARLY_ELASTIC
    );
    page += &impacts(judgements).shown().markdown();
    let noted = judgements.iter().filter(|row| !row.notes().is_empty());
    let remarks: String = noted.map(remark).collect();
    if !remarks.is_empty() {
        page += "\n## Remarks\n\n";
    }
    page + &remarks
}

fn remark(row: &ImpactJudgement) -> String {
    let (code, verdict, impact) = (row.code.clone(), row.grounds.in_words(), &row.study.impact);
    let (target, quantity) = (impact.target.as_str(), row.study.quantity.as_str());
    let (speed, restitution) = (
        impact.approach_speed,
        rounded(impact.convention.restitution),
    );
    let notes = markdown_notes(&row.notes().join("\n"));
    format!(
        "- **{code}, {target}, speed {speed}, e_r {restitution}, {quantity}: {verdict}**\n\n  {notes}\n"
    )
}
