//! What an experiment will show, in SI units.

use super::number::{friction, optional, rounded, significant};
use super::table::Table;
use crate::experiment::{ContactEstimate, Force, ForceRange, Forecast, Forecasted};
use serde::Serialize;

/// As one object.
pub fn forecast_json(forecast: &Forecast) -> String {
    serde_json::to_string_pretty(forecast).expect("plain data has a JSON form") + "\n"
}

#[derive(Serialize)]
struct FlatRow {
    contact: ContactEstimate,
    mu: f64,
    mass: f64,
    weight: f64,
    normal_stiffness: f64,
    epsilon: f64,
    stiffness: f64,
    event: String,
    overlap: f64,
    yield_force: Option<f64>,
    yield_force_newton: Option<f64>,
    perturbation: Option<f64>,
    perturbation_newton: Option<f64>,
    paper_formula_newton: f64,
    largest_force_newton: Option<f64>,
    lowest_newton: Option<f64>,
    highest_newton: Option<f64>,
}

/// One line an estimate of the contact; the range is that of all of them.
pub fn forecast_csv(forecast: &Forecast) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let weights = |force: Option<Force>| force.map(|force| force.weights);
    let newton = |force: Option<Force>| force.map(|force| force.newton);
    for estimate in &forecast.estimates {
        let row = FlatRow {
            contact: estimate.contact,
            mu: forecast.experiment.mu,
            mass: forecast.mass,
            weight: forecast.weight,
            normal_stiffness: estimate.normal_stiffness,
            epsilon: estimate.epsilon,
            stiffness: estimate.stiffness,
            event: estimate.event.to_string(),
            overlap: estimate.overlap,
            yield_force: weights(estimate.yield_force),
            yield_force_newton: newton(estimate.yield_force),
            perturbation: weights(estimate.perturbation),
            perturbation_newton: newton(estimate.perturbation),
            paper_formula_newton: estimate.paper_formula.newton,
            largest_force_newton: newton(estimate.largest_force),
            lowest_newton: forecast.range.lowest,
            highest_newton: forecast.range.highest,
        };
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// The estimates side by side, for people.
pub fn forecast_table(forecast: &Forecast) -> String {
    let mut lines = vec![heading(forecast)];
    lines.push(estimates(&forecast.estimates).terminal());
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

fn estimates(estimates: &[Forecasted]) -> Table {
    let mut table = Table::new(&[
        "quantity",
        "paper-scaling>",
        "line-contact>",
        "hertz>",
        "unit",
    ]);
    let mut line = |name: &str, unit: &str, cell: &dyn Fn(&Forecasted) -> String| {
        let cells = estimates.iter().map(cell);
        let name = std::iter::once(name.to_owned());
        table.push(name.chain(cells).chain([unit.to_owned()]).collect());
    };
    let newton = |force: Option<Force>| optional(force, |force| significant(force.newton, 4));
    line("k_n", "N/m", &|one| significant(one.normal_stiffness, 4));
    line("epsilon = m g/(k_n r)", "", &|one| {
        significant(one.epsilon, 4)
    });
    line("stiffness 1/epsilon", "", &|one| {
        significant(one.stiffness, 4)
    });
    line("first event", "", &|one| one.event.to_string());
    line("overlap then", "r", &|one| significant(one.overlap, 3));
    line("yield force, exact limit", "m g", &|one| {
        optional(one.yield_force, |force| significant(force.weights, 6))
    });
    line("yield force, exact limit", "N", &|one| {
        newton(one.yield_force)
    });
    line("paper's perturbation", "N", &|one| newton(one.perturbation));
    line("paper's f = m g/epsilon, mu > mu_c", "N", &|one| {
        newton(Some(one.paper_formula))
    });
    line("largest force", "N", &|one| newton(one.largest_force));
    table
}

/// The force by the estimate that counts, between those by all of them.
fn conclusion(forecast: &Forecast) -> String {
    let chosen = forecast
        .estimates
        .iter()
        .find(|estimate| estimate.contact == forecast.contact);
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
