//! The forecast for an experiment, in SI units.

use super::number::{digits, friction, rounded, significant};
use super::table::{Columns, DataTable, Value};
use crate::experiment::{ContactEstimate, Experiment, Force, ForceRange, Forecast, Forecasted};

type Row<'a> = (&'a Forecast, &'a Forecasted);

/// One row per estimate of the contact.
pub(crate) fn forecasts(forecasts: &[Forecast]) -> DataTable<'_> {
    let rows = forecasts.iter().flat_map(|all| {
        let estimates = all.estimates.iter();
        estimates.map(move |own| (all, own))
    });
    let newton = |force: Option<Force>| force.map(|force| force.newton);
    let weights = |force: Option<Force>| force.map(|force| force.weights);
    experiment(Columns::<Row>::new(
        "forecast",
        "A row is one estimate of the contact of real cylinders and what follows from it; `range_lowest` and \
         `range_highest` are over all rows.",
        "`tristack predict`",
    ))
    .text("contact", "the estimate of the contact", |(_, own)| own.contact.as_str())
    .text("chosen", "whether it is the chosen estimate", |(all, own)| {
        all.contact == own.contact
    })
    .number("normal_stiffness", "N/m", "k_n", |(_, own)| own.normal_stiffness)
    .shown_as("k_n", digits::<4>)
    .number("epsilon", "1", "ε = m g/(k_n r)", |(_, own)| own.epsilon)
    .shown_as("epsilon = m g/(k_n r)", digits::<4>)
    .number("stiffness", "m g/r", "normal stiffness k_n, 1/ε", |(_, own)| own.stiffness)
    .shown_as("stiffness 1/epsilon", digits::<4>)
    .text("event", "what comes first on the path of equilibria", |(_, own)| own.event.to_string())
    .shown("first event")
    .text("reason", "what that means, where it is no yield", |(_, own)| own.reason.clone())
    .number("overlap", "r", "overlap of the contacts between the cylinders then", |(_, own)| own.overlap)
    .shown_as("overlap then", digits::<3>)
    .number("yield_force", "m g", "exact quasi-static yield force", move |(_, own)| {
        weights(own.yield_force)
    })
    .shown_as("yield force, exact limit", digits::<6>)
    .number("yield_force_newton", "N", "the same", move |(_, own)| newton(own.yield_force))
    .shown_as("yield force, exact limit", digits::<4>)
    .number("perturbation", "m g", "the paper's perturbation result", move |(_, own)| {
        weights(own.perturbation)
    })
    .number("perturbation_newton", "N", "the same", move |(_, own)| newton(own.perturbation))
    .shown_as("paper's perturbation", digits::<4>)
    .number("paper_formula", "m g", "the paper's f = m g/ε, meant for μ > μ_c", |(_, own)| {
        own.paper_formula.weights
    })
    .number("paper_formula_newton", "N", "the same", |(_, own)| own.paper_formula.newton)
    .shown_as("paper's f = m g/epsilon, mu > mu_c", digits::<4>)
    .number(
        "largest_force",
        "m g",
        "largest force that the stack carries, whatever ends it; absent where it grows without a peak",
        move |(_, own)| weights(own.largest_force),
    )
    .number("largest_force_newton", "N", "the same", move |(_, own)| newton(own.largest_force))
    .shown_as("largest force", digits::<4>)
    .number(
        "range_lowest",
        "N",
        "lowest of the largest forces over all estimates and all μ within its uncertainty",
        |(all, _)| all.range.lowest,
    )
    .number("range_highest", "N", "the highest; absent if one of them has no peak", |(all, _)| {
        all.range.highest
    })
    .rows(rows)
}

/// The columns of the cylinders.
fn experiment<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let own = |(forecast, _): &Row| -> Experiment { forecast.experiment };
    columns
        .number("mu", "1", "floor friction μ", move |row| own(row).mu)
        .number(
            "mu_uncertainty",
            "1",
            "what μ is known to, as ±",
            move |row| own(row).mu_uncertainty,
        )
        .number(
            "mu_d",
            "1",
            "friction μ_d between the cylinders",
            move |row| own(row).mu_d,
        )
        .number("kappa", "1", "stiffness ratio κ = k_n/k_t", move |row| {
            own(row).kappa
        })
        .text(
            "regime",
            "on which side of μ_c the floor is",
            |(forecast, _)| Value::word(forecast.regime),
        )
        .number("youngs_modulus", "Pa", "Young's modulus E", move |row| {
            own(row).cylinder.youngs_modulus
        })
        .number("poisson_ratio", "1", "Poisson's ratio ν", move |row| {
            own(row).cylinder.poisson_ratio
        })
        .number("density", "kg/m³", "density ρ", move |row| {
            own(row).cylinder.density
        })
        .number("radius", "m", "radius r", move |row| {
            own(row).cylinder.radius
        })
        .number("length", "m", "length l along the axis", move |row| {
            own(row).cylinder.length
        })
        .number("mass", "kg", "mass m", |(forecast, _)| forecast.mass)
        .number("weight", "N", "weight m g", |(forecast, _)| forecast.weight)
}

/// The estimates side by side, for people.
pub(crate) fn forecast_text(forecast: &Forecast) -> String {
    let names: Vec<&str> = forecast
        .estimates
        .iter()
        .map(|own| own.contact.as_str())
        .collect();
    let mut lines = vec![heading(forecast)];
    let table = forecasts(std::slice::from_ref(forecast));
    lines.push(table.transposed(&names).terminal());
    lines.push(conclusion(forecast));
    for contact in ContactEstimate::ALL {
        lines.push(format!("{contact}: {}\n", contact.formula()));
    }
    lines.concat()
}

fn heading(forecast: &Forecast) -> String {
    let experiment = &forecast.experiment;
    let cylinder = &experiment.cylinder;
    format!(
        "cylinders of E = {} Pa, nu = {}, rho = {} kg/m3, r = {} m, l = {} m: m = {} kg, m g = {} N\n\
         mu = {}{} ({}), mu_d = {}, kappa = {}\n",
        rounded(cylinder.youngs_modulus),
        cylinder.poisson_ratio,
        rounded(cylinder.density),
        rounded(cylinder.radius),
        rounded(cylinder.length),
        rounded(forecast.mass),
        rounded(forecast.weight),
        friction(experiment.mu),
        plus_minus(experiment.mu_uncertainty),
        forecast.regime,
        experiment.mu_d,
        experiment.kappa,
    )
}

fn plus_minus(uncertainty: f64) -> String {
    if uncertainty > 0.0 {
        format!(" +- {uncertainty}")
    } else {
        String::new()
    }
}

/// The yield force by the chosen estimate, and the range over all estimates.
fn conclusion(forecast: &Forecast) -> String {
    let mut estimates = forecast.estimates.iter();
    let chosen = estimates.find(|estimate| estimate.contact == forecast.contact);
    let reason = chosen.and_then(|estimate| estimate.reason.as_deref());
    let said = match (forecast.yield_force, reason) {
        (Some(force), _) => format!("yield force {} N", significant(force.newton, 4)),
        (None, Some(reason)) => format!("no yield force: {reason}"),
        (None, None) => "no yield force".to_owned(),
    };
    let uncertainty = forecast.experiment.mu_uncertainty;
    let over = if uncertainty > 0.0 {
        format!("over the estimates and mu +- {uncertainty}")
    } else {
        "over the estimates".to_owned()
    };
    let range = forces_between(&forecast.range);
    format!("{said} by {}; {over}, {range}\n", forecast.contact)
}

fn forces_between(range: &ForceRange) -> String {
    let newton = |force: f64| significant(force, 3);
    match (range.lowest, range.highest) {
        (Some(lowest), Some(highest)) => format!(
            "the largest force is {} to {} N",
            newton(lowest),
            newton(highest)
        ),
        (Some(lowest), None) => format!(
            "the largest force is {} N or more, without a peak for some",
            newton(lowest)
        ),
        _ => "the force grows without a peak".to_owned(),
    }
}
