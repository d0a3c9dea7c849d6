//! The forecast for an experiment, in SI units.

use super::number::{digits, friction, rounded, significant};
use super::table::{Columns, DataTable};
use crate::experiment::{ContactEstimate, Experiment, Force, ForceRange, Forecast, Forecasted};
use crate::model::exact;
use crate::study::yield_force::no_yield;
use crate::theory::quasistatic_limit;

type Row<'a> = (&'a Forecast, &'a Forecasted);

/// Returns the table of forecasts, one row per estimate of the contact.
pub fn forecasts(forecasts: &[Forecast]) -> DataTable<'_> {
    let rows = forecasts.iter().flat_map(|all| {
        let estimates = all.estimates.iter();
        estimates.map(move |own| (all, own))
    });
    let newton = |force: Option<Force>| force.map(|force| force.newton);
    let weights = |force: Option<Force>| force.map(|force| force.weights);
    experiment(Columns::<Row>::new(
        "forecast",
        "A row is one estimate of the contact of real cylinders and what follows from it; \
         `range_lowest` and `range_highest` are over all rows.",
        "`tristack predict`",
    ))
    .text("contact", |(_, own)| own.contact.as_str())
    .means("the estimate of the contact")
    .text("chosen", |(all, own)| all.contact == own.contact)
    .means("whether it is the chosen estimate")
    .number("normal_stiffness", "N/m", |(_, own)| own.normal_stiffness)
    .means("k_n")
    .shown_as("k_n", digits::<4>)
    .number("epsilon", "1", |(_, own)| own.epsilon)
    .means("ε = m g/(k_n r)")
    .shown_as("epsilon = m g/(k_n r)", digits::<4>)
    .number("stiffness", "m g/r", |(_, own)| own.stiffness)
    .means("normal stiffness k_n, 1/ε")
    .shown_as("stiffness 1/epsilon", digits::<4>)
    .text("event", |(_, own)| own.event.to_string())
    .means("what comes first on the path of equilibria")
    .shown("first event")
    .text("reason", |(_, own)| own.reason.clone())
    .means("what that means, where it is no yield")
    .number("overlap", "r", |(_, own)| own.overlap)
    .means("overlap of the contacts between the cylinders then")
    .shown_as("overlap then", digits::<3>)
    .number("yield_force", "m g", move |(_, own)| {
        weights(own.yield_force)
    })
    .means("exact quasi-static yield force")
    .shown_as("yield force, exact limit", digits::<6>)
    .number("yield_force_newton", "N", move |(_, own)| {
        newton(own.yield_force)
    })
    .means("the same")
    .shown_as("yield force, exact limit", digits::<4>)
    .number("slip_onset", "m g", move |(_, own)| weights(own.slip_onset))
    .means("exact force at which the floor begins to slip; below yield_force where the bottom cylinders touch then")
    .number("slip_onset_newton", "N", move |(_, own)| {
        newton(own.slip_onset)
    })
    .means("the same")
    .number("perturbation", "m g", move |(_, own)| {
        weights(own.perturbation)
    })
    .means("the paper's perturbation result")
    .number("perturbation_newton", "N", move |(_, own)| {
        newton(own.perturbation)
    })
    .means("the same")
    .shown_as("paper's perturbation", digits::<4>)
    .number("paper_formula", "m g", |(_, own)| own.paper_formula.weights)
    .means("the paper's f = m g/ε, meant for μ > μ_c")
    .number("paper_formula_newton", "N", |(_, own)| {
        own.paper_formula.newton
    })
    .means("the same")
    .shown_as("paper's f = m g/epsilon, mu > mu_c", digits::<4>)
    .number("largest_force", "m g", move |(_, own)| {
        weights(own.largest_force)
    })
    .means(
        "largest force that the stack carries, whatever ends it; absent where it grows \
             without a peak",
    )
    .number("largest_force_newton", "N", move |(_, own)| {
        newton(own.largest_force)
    })
    .means("the same")
    .shown_as("largest force", digits::<4>)
    .number("range_lowest", "N", |(all, _)| all.range.lowest)
    .means("lowest of the largest forces over all estimates and all μ within its uncertainty")
    .number("range_highest", "N", |(all, _)| all.range.highest)
    .means("the highest; absent if one of them has no peak")
    .rows(rows)
}

/// Adds the columns of the experiment: frictions, stiffness ratio, and the cylinders.
fn experiment<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let own = |(forecast, _): &Row| -> Experiment { forecast.experiment };
    columns
        .number("mu", "1", move |row| own(row).mu)
        .means("floor friction μ")
        .number("mu_uncertainty", "1", move |row| own(row).mu_uncertainty)
        .means("what μ is known to, as ±")
        .number("mu_d", "1", move |row| own(row).mu_d)
        .means("friction μ_d between the cylinders")
        .number("kappa", "1", move |row| own(row).kappa)
        .means("stiffness ratio κ = k_n/k_t")
        .word("regime", |(forecast, _)| forecast.regime)
        .means("on which side of μ_c the floor is")
        .number("youngs_modulus", "Pa", move |row| {
            own(row).cylinder.youngs_modulus
        })
        .means("Young's modulus E")
        .number("poisson_ratio", "1", move |row| {
            own(row).cylinder.poisson_ratio
        })
        .means("Poisson's ratio ν")
        .number("density", "kg/m³", move |row| own(row).cylinder.density)
        .means("density ρ")
        .number("radius", "m", move |row| own(row).cylinder.radius)
        .means("radius r")
        .number("length", "m", move |row| own(row).cylinder.length)
        .means("length l along the axis")
        .number("mass", "kg", |(forecast, _)| forecast.mass)
        .means("mass m")
        .number("weight", "N", |(forecast, _)| forecast.weight)
        .means("weight m g")
}

/// Formats the estimates side by side, for people.
pub fn forecast_text(forecast: &Forecast) -> String {
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
        exact(experiment.mu_d),
        exact(experiment.kappa),
    )
}

fn plus_minus(uncertainty: f64) -> String {
    if uncertainty > 0.0 {
        format!(" +- {}", exact(uncertainty))
    } else {
        String::new()
    }
}

/// States the yield force by the chosen estimate, and the range over all estimates.
fn conclusion(forecast: &Forecast) -> String {
    let mut estimates = forecast.estimates.iter();
    let chosen = estimates.find(|estimate| estimate.contact == forecast.contact);
    let said = match forecast.yield_force {
        Some(force) => {
            let onset = chosen.and_then(|estimate| estimate.slip_onset);
            let onset = onset.filter(|onset| onset.newton < force.newton);
            let slips = onset.map_or_else(String::new, |onset| {
                let newton = significant(onset.newton, 4);
                format!(" (the floor begins to slip at {newton} N)")
            });
            format!("yield force {} N{slips}", significant(force.newton, 4))
        }
        None => return chosen.map_or_else(String::new, |chosen| no_yield_force(forecast, chosen)),
    };
    let over = over(forecast);
    let range = forces_between(&forecast.range);
    format!("{said} by {}; {over}, {range}\n", forecast.contact)
}

/// Says why the `chosen` estimate gives no yield, what the stack carries instead, and at which frictions it yields.
fn no_yield_force(forecast: &Forecast, chosen: &Forecasted) -> String {
    let problem = &chosen.problem;
    let refused = no_yield(problem, &quasistatic_limit(problem));
    let carries = match forecast.range.highest {
        Some(0.0) => "it carries no load".to_owned(),
        _ => format!("{}, {}", over(forecast), forces_between(&forecast.range)),
    };
    let yields = refused.range.map_or_else(String::new, |(lowest, highest)| {
        format!(
            "; by {} it yields where mu is between {lowest:.4} and {highest:.4}",
            chosen.contact
        )
    });
    format!(
        "no yield force at mu = {}: {}; {carries}{yields}\n",
        friction(forecast.experiment.mu),
        refused.reason
    )
}

/// Says over what the range of forces is taken.
fn over(forecast: &Forecast) -> String {
    let uncertainty = forecast.experiment.mu_uncertainty;
    if uncertainty > 0.0 {
        format!("over the estimates and mu +- {uncertainty}")
    } else {
        "over the estimates".to_owned()
    }
}

fn forces_between(range: &ForceRange) -> String {
    let newton = |force: f64| significant(force, 3);
    match (range.lowest, range.highest) {
        (Some(0.0), Some(highest)) => format!(
            "the largest force is at most {} N, and none where the stack slides under its own weight",
            newton(highest)
        ),
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
