//! The yield force by every theory.

use super::number::{digits, friction, optional};
use super::table::{Columns, DataTable, Table};
use crate::theory::Predictions;

/// One row per stack.
pub(crate) fn theory(predictions: &[Predictions]) -> DataTable<'_> {
    Columns::<&Predictions>::new(
        "theory",
        "A row is one stack with its yield force F by every theory.",
        "`tristack theory`",
    )
    .stack(|own| own.stack)
    .number("epsilon", "1", "ε = m g/(k_n r)", |own| {
        own.stack.epsilon()
    })
    .number(
        "rigid",
        "m g",
        "rigid cylinders; absent where infinite",
        |own| own.rigid.yield_force,
    )
    .text(
        "rigid_diverges",
        "whether it is infinite, μ ≥ μ_c",
        |own| own.rigid.diverges,
    )
    .number("naive", "m g", "naive expansion", |own| {
        own.naive.yield_force
    })
    .text("naive_reason", "why it gives none", |own| own.naive.reason)
    .number("perturbation", "m g", "singular perturbation", |own| {
        own.perturbation.yield_force
    })
    .text("perturbation_reason", "why it gives none", |own| {
        own.perturbation.reason
    })
    .number("elastic", "m g", "elastic equation", |own| {
        own.elastic.yield_force
    })
    .number("elastic_x", "r", "its x = δ₁₁ − δ₂₁", |own| {
        own.elastic_root.map(|root| root.x)
    })
    .number("elastic_y", "r", "its y = δ₂₂", |own| {
        own.elastic_root.map(|root| root.y)
    })
    .number("elastic_z", "r", "its z = δ₂₁", |own| {
        own.elastic_root.map(|root| root.z)
    })
    .number("elastic_theta", "rad", "its θ", |own| {
        own.elastic_root.map(|root| root.theta)
    })
    .text("elastic_reason", "why it gives none", |own| {
        own.elastic.reason
    })
    .text(
        "elastic_caution",
        "an assumption that its root contradicts",
        |own| own.elastic_root.and_then(|root| root.caution()),
    )
    .number(
        "quasistatic",
        "m g",
        "exact quasi-static limit of a DEM with these arms",
        |own| own.quasistatic.yield_force,
    )
    .text("reason", "why there is no quasi-static limit", |own| {
        own.quasistatic.reason.clone()
    })
    .text(
        "event",
        "what comes first on the path of equilibria",
        |own| own.quasistatic.event.to_string(),
    )
    .number(
        "floor_slip_force",
        "m g",
        "F at which the floor slips if other events are ignored",
        |own| own.quasistatic.floor_slip_force,
    )
    .convention(|own| own.convention)
    .number("T", "1", "T = tan(ψ/2) where the floor slips", |own| {
        own.quasistatic.tangent
    })
    .number("y", "r", "y = x₂ − r where the floor slips", |own| {
        own.quasistatic.y
    })
    .number(
        "z",
        "r",
        "overlap of cylinder 2 and the floor where the floor slips",
        |own| own.quasistatic.z,
    )
    .number(
        "wall_travel",
        "r",
        "how far the wall has moved when the floor slips",
        |own| own.quasistatic.wall_travel,
    )
    .rows(predictions)
}

/// For people: a table per stack, with a line per theory.
pub(crate) fn theories_by_stack(predictions: &[Predictions]) -> String {
    let tables = predictions.iter().map(|case| {
        let heading = format!(
            "mu = {}, stiffness k_n r/(m g) = {}, kappa = {}, mu_d = {}, {}\n",
            friction(case.stack.floor_friction),
            case.stack.stiffness,
            case.stack.stiffness_ratio,
            case.stack.cylinder_friction,
            case.convention
        );
        heading + &one_case(case).terminal()
    });
    tables.collect::<Vec<_>>().join("\n")
}

/// One theory of one stack: its name, its yield force, and a remark.
type Line = (&'static str, Option<f64>, String);

fn one_case(case: &Predictions) -> Table {
    let text = |reason: Option<&str>| reason.unwrap_or_default().to_owned();
    let rigid_remark = case.rigid.diverges.then_some("infinite: mu >= mu_c");
    let (elastic, exact) = (&case.elastic, &case.quasistatic);
    let elastic_caution = case.elastic_root.and_then(|root| root.caution());
    let exact_remark = exact.reason.clone().unwrap_or_else(|| "exact".to_owned());
    let mut lines: Vec<Line> = vec![
        ("rigid", case.rigid.yield_force, text(rigid_remark)),
        ("naive", case.naive.yield_force, text(case.naive.reason)),
        (
            "perturbation",
            case.perturbation.yield_force,
            text(case.perturbation.reason),
        ),
        (
            "elastic equation",
            elastic.yield_force,
            text(elastic.reason.or(elastic_caution)),
        ),
        ("quasi-static limit", exact.yield_force, exact_remark),
    ];
    if exact.yield_force.is_none() && exact.floor_slip_force.is_some() {
        let remark = format!("if {} is ignored", exact.event);
        lines.push(("", exact.floor_slip_force, remark));
    }
    Columns::<Line>::for_people()
        .left("theory", |(name, ..)| name.to_string())
        .right("yield force F", |(_, force, _)| {
            optional(*force, digits::<10>)
        })
        .left("remark", |(.., remark)| remark.clone())
        .rows(lines)
        .shown()
}
