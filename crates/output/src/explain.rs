//! The explanation of one row: every step from its runs to its verdict.

use super::crosscheck::shown_arms;
use super::explained::{explained_runs, origin_of_arms};
use super::number::{digits, friction, optional, relative, significant};
use super::table::Columns;
use crate::model::exact;
use crate::runs::RunSummary;
use crate::series::MechanicalLaw;
use crate::study::MIN_TOLERANCE;
use crate::study::yield_force::{
    Budget, ConvergenceOrder, Evidence, Extrapolation, Judgement, Method, TwinForce,
};

/// Formats the steps that lead to the verdict of `row`, for a terminal. `twin` is the same force from runs with more
/// digits; `coverage` says what the identity of an installed code covers.
pub fn explanation(
    row: &Judgement,
    twin: Option<&Result<TwinForce, String>>,
    coverage: Option<&str>,
) -> String {
    let mut text = reference(row);
    text += &runs(row);
    let peak = row.finding.as_ref().and_then(|found| found.peak);
    if let Some(peak) = peak.filter(|_| row.study.method == Method::Literal) {
        text += &less_speed(row, &peak);
        text += &budget(row, &peak);
    }
    if let Some(slip) = row.slip() {
        text += &extrapolation(row, slip);
        text += &budget(row, slip);
        text += &round_off(slip, twin);
    }
    text += &conclusion(row);
    if let Some(coverage) = coverage {
        text += &format!(
            "\n8. Identity: runs are taken from the store only where this has not changed: {coverage}.\n"
        );
    }
    text
}

fn reference(row: &Judgement) -> String {
    let arms = row.known_convention().arms;
    let limit = &row.study.limit;
    let text = format!(
        "{} {} ({}): mu = {}, stiffness k_n r/(m g) = {}, kappa = {}, mu_d = {}\n\n\
         1. Reference value D: exact quasi-static limit with arms {}, {} ({}): F = {}\n   \
         (guaranteed to {MIN_TOLERANCE:e} of F + n + 1; docs/theory.md). Model form, its distance from the paper's \
         convention: {}\n   of F + n + 1; a property of the model, no error of the code.\n\n",
        row.code,
        row.version,
        row.source.as_str(),
        friction(row.mu()),
        row.stiffness(),
        exact(row.study.stack.stiffness_ratio),
        exact(row.study.stack.cylinder_friction),
        shown_arms(arms.pair),
        shown_arms(arms.floor),
        match origin_of_arms(row) {
            "declared" => "declared".to_owned(),
            measured => format!("{measured}: tristack probe"),
        },
        optional(row.judged_reference(), digits::<12>),
        optional(row.model_form(), relative),
    );
    // Under arms that are not known, no peak is known either.
    if row.reference_force().is_none() || !limit.rises_after_onset() {
        return text;
    }
    text + &format!(
        "   It is the slip onset. There the bottom cylinders press on each other with c = {} m g, and the force rises\n   \
         further, to the peak, which is the yield force: {}. Measured: {}\n\n",
        optional(limit.bottom_force, digits::<4>),
        optional(limit.peak_force, digits::<12>),
        optional(row.peak(), |(force, uncertainty)| format!(
            "{} +- {uncertainty:.0e}",
            significant(force, 9)
        )),
    )
}

fn runs(row: &Judgement) -> String {
    let table = explained_runs(std::slice::from_ref(row));
    format!(
        "2. Runs: slip onset{} and peak{} of F = f/(m g), with the distance between interpolations of two\n   orders, and \
         how much an error of the forces is amplified where the onset is read.\n{}{}\n",
        if row.study.method == Method::Literal {
            ""
        } else {
            " (judged)"
        },
        if row.study.method == Method::Literal {
            " (judged)"
        } else {
            ""
        },
        table.shown().terminal(),
        mechanics(row.runs())
    )
}

/// Reports the largest deviation of the runs from each law of mechanics, as a share of what is allowed.
fn mechanics(runs: &[RunSummary]) -> String {
    if runs.is_empty() {
        return String::new();
    }
    let laws = MechanicalLaw::ALL.map(|law| {
        let deviations = runs
            .iter()
            .filter_map(|run| run.mechanics.as_ref()?.0.get(&law));
        let share = deviations.map(|deviation| deviation.size / deviation.bound);
        let share = share.fold(None, |most: Option<f64>, share| {
            Some(share.max(most.unwrap_or(0.0)))
        });
        format!(
            "{} {}",
            law.as_str(),
            share.map_or("not tested".to_owned(), |share| format!("{share:.2}"))
        )
    });
    format!(
        "   Mechanics (docs/theory.md, 8.6), largest deviation in units of the allowed one: {},\n   {}.\n",
        laws[..2].join(", "),
        laws[2..].join(", ")
    )
}

fn extrapolation(row: &Judgement, slip: &Extrapolation) -> String {
    let order = match slip.order.observed {
        Some(observed) => format!(
            "{observed:.4}, expected {} within {:.2}",
            ConvergenceOrder::range(row.study.expected_orders()),
            slip.order.allowance
        ),
        None => "below the noise, not observable".to_owned(),
    };
    format!(
        "3. Vanishing wall speed: parabola through runs 1 to 3 (weights 1/3, -2, 8/3): S = {}\n   \
         straight line through runs 2 and 3: {}\n   observed order of convergence: {order}\n\n",
        significant(slip.force, 12),
        significant(slip.first_order, 12)
    )
}

/// Lists the peak at each wall speed, less what theory expects that speed to add.
fn less_speed(row: &Judgement, found: &Extrapolation) -> String {
    let runs = row.study.cases.iter().zip(row.runs());
    let less = runs.map(|(case, run)| {
        let speed = case.protocol.wall_speed;
        let peak = run.estimates.peak?.force;
        let added = row.study.speed_excess.map(|excess| excess.peak * speed);
        Some((speed, peak, added))
    });
    let lines = less.flatten().map(|(speed, peak, added)| {
        let expected = added.map_or("not known".to_owned(), |added| significant(added, 5));
        let left = significant(peak - added.unwrap_or(0.0), 12);
        format!(
            "   v = {speed:e}: peak {}, of its speed {expected}, left {left}\n",
            significant(peak, 12)
        )
    });
    let lines: Vec<String> = lines.collect();
    format!(
        "3. Finite wall speed: what theory expects v to add to the peak, to first order (docs/theory.md, 8.7):\n{}   \
         S = {}\n\n",
        lines.concat(),
        significant(found.force, 12)
    )
}

fn budget(row: &Judgement, slip: &Extrapolation) -> String {
    let reference = row.judged_reference();
    let load = reference.map_or(f64::NAN, |force| row.study.stack.floor_load(force));
    let parts = Budget::PARTS.into_iter().filter_map(|part| {
        let value = (part.value)(&slip.budget)?;
        Some((
            part.heading,
            part.how(row.study.method, &row.study.roles),
            value,
        ))
    });
    let total = ("total", "sum, as if all conspired", slip.budget.total());
    let table = Columns::<(&str, &str, f64)>::for_people()
        .left("part of u_num", |(name, ..)| name.to_string())
        .left("how", |(_, how, _)| how.to_string())
        .right("m g", |(.., value)| format!("{value:.1e}"))
        .right("of F + n + 1", move |(.., value)| {
            format!("{:.1e}", value / load)
        })
        .rows(parts.chain([total]));
    format!(
        "4. Numerical uncertainty of S (ASME V&V 20):\n{}\n",
        table.shown().terminal()
    )
}

fn round_off(slip: &Extrapolation, twin: Option<&Result<TwinForce, String>>) -> String {
    let text = match twin {
        None => "there is no build of this code with more digits here".to_owned(),
        Some(Err(error)) => format!("the twin failed: {error}"),
        Some(Ok(twin)) => format!(
            "the same runs in {} give S = {}, {:+.1e} away",
            twin.version,
            significant(twin.force, 12),
            slip.force - twin.force
        ),
    };
    format!("5. Round-off, measured: {text}\n\n")
}

fn conclusion(row: &Judgement) -> String {
    let evidence = Evidence::of(row);
    let mut text = format!(
        "6. Comparison error E = S - D: {} of F + n + 1; tolerance {}\n   (the uncertainty, but at least {MIN_TOLERANCE:e} \
         and at most {:e}): {}\n",
        optional(row.error(), relative),
        optional(row.tolerance(), |tolerance| format!("{tolerance:.1e}")),
        row.study.resolution,
        row.grounds.in_words()
    );
    for note in &row.notes() {
        text += &format!("   {note}\n");
    }
    text + &format!(
        "\n7. Evidence: {}. It does not prove {}.\n",
        evidence.as_str(),
        evidence.does_not_prove()
    )
}
