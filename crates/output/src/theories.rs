//! The yield force by every theory.

use super::number::{digits, friction, optional};
use super::table::{Columns, DataTable, Table};
use crate::model::{PAPER_BODIES, exact};
use crate::theory::Predictions;

/// Returns the table of theories, one row per stack.
pub fn theory(predictions: &[Predictions]) -> DataTable<'_> {
    Columns::<&Predictions>::new(
        "theory",
        "A row is one stack with its yield force F by every theory.",
        "`tristack theory`",
    )
    .stack(|own| *own.problem.stack())
    .number("epsilon", "1", |own| own.problem.stack().epsilon())
    .means("ε = m g/(k_n r)")
    .number("rigid", "m g", |own| own.rigid.yield_force)
    .means("rigid bodies; absent where infinite")
    .text("rigid_diverges", |own| own.rigid.diverges)
    .means("whether it is infinite, μ ≥ μ_c")
    .number("naive", "m g", |own| own.naive.yield_force)
    .means("naive expansion")
    .text("naive_reason", |own| own.naive.reason)
    .means("why it gives none")
    .number("perturbation", "m g", |own| own.perturbation.yield_force)
    .means("singular perturbation")
    .text("perturbation_reason", |own| own.perturbation.reason)
    .means("why it gives none")
    .number("elastic", "m g", |own| own.elastic.yield_force)
    .means("elastic equation")
    .number("elastic_x", "r", |own| own.elastic_root.map(|root| root.x))
    .means("its x = δ₁₁ − δ₂₁")
    .number("elastic_y", "r", |own| own.elastic_root.map(|root| root.y))
    .means("its y = δ₂₂")
    .number("elastic_z", "r", |own| own.elastic_root.map(|root| root.z))
    .means("its z = δ₂₁")
    .number("elastic_theta", "rad", |own| {
        own.elastic_root.map(|root| root.theta)
    })
    .means("its θ")
    .text("elastic_reason", |own| own.elastic.reason)
    .means("why it gives none")
    .text("elastic_caution", |own| {
        own.elastic_root.and_then(|root| root.caution())
    })
    .means("an assumption that its root contradicts")
    .number("quasistatic", "m g", |own| own.quasistatic.yield_force)
    .means("exact quasi-static limit of a DEM with these arms and this law")
    .number("quasistatic.slip_onset", "m g", |own| {
        own.quasistatic.slip_onset
    })
    .means("F at which the floor begins to slip under the wall")
    .number("quasistatic.peak_force", "m g", |own| {
        own.quasistatic.peak_force
    })
    .means("the largest F: larger where contact 2–3 is closed at the onset, c > 0, and the same where c = 0")
    .number("quasistatic.yield_force", "m g", |own| {
        own.quasistatic.yield_force
    })
    .means("the peak, as `quasistatic`")
    .number("quasistatic.c", "m g", |own| own.quasistatic.bottom_force)
    .means("force c between two of the bottom bodies where the floor slips")
    .text("reason", |own| own.quasistatic.reason.clone())
    .means("why there is no quasi-static limit")
    .text("event", |own| own.quasistatic.event.to_string())
    .means("what comes first on the path of equilibria")
    .number("floor_slip_force", "m g", |own| {
        own.quasistatic.floor_slip_force
    })
    .means("F at which the floor slips if other events are ignored; the closing of contact 2–3 is not")
    .convention(|own| Some((*own.problem.convention()).into()))
    .law(|own| Some(own.problem.convention().law))
    .number("T", "1", |own| own.quasistatic.tangent)
    .means("T = tan(ψ/2) where the floor slips")
    .number("y", "r", |own| own.quasistatic.y)
    .means("y = x₂ − x₀ where the floor slips, how far the bottom bodies have moved outwards")
    .number("z", "r", |own| own.quasistatic.z)
    .means("overlap of body 2 and the floor where the floor slips")
    .number("wall_travel", "r", |own| own.quasistatic.wall_travel)
    .means("how far the wall has moved when the floor slips")
    .number("peak_travel", "r", |own| own.quasistatic.peak_travel)
    .means("the same at the peak")
    .number("wall_speed", "r √(k_n/m)", |own| {
        own.moving.map(|wall| wall.speed)
    })
    .means("the speed of the wall that `--speed` gives")
    .number("peak_at_speed", "m g", |own| own.moving_peak())
    .means("F at the peak of a DEM whose wall has that speed, to first order in it")
    .number("peak_per_speed", "m g √(m/k_n)/r", |own| {
        Some(own.moving?.excess?.peak)
    })
    .means("what the speed adds to the peak, per speed")
    .number("onset_per_speed", "m g √(m/k_n)/r", |own| {
        Some(own.moving?.excess?.onset)
    })
    .means("what it adds to the onset of slip, per speed")
    .rows(predictions)
}

/// Formats one table per stack for people, one line per theory.
pub fn theories_by_stack(predictions: &[Predictions]) -> String {
    let tables = predictions.iter().map(|case| {
        let (stack, convention) = (case.problem.stack(), case.problem.convention());
        let bodies = match stack.bodies {
            PAPER_BODIES => String::new(),
            more => format!("{more} spheres below, "),
        };
        let heading = format!(
            "{bodies}mu = {}, stiffness k_n r/(m g) = {}, kappa = {}, mu_d = {}, {convention}\n",
            friction(stack.floor_friction),
            stack.stiffness,
            exact(stack.stiffness_ratio),
            exact(stack.cylinder_friction)
        );
        heading + &one_case(case).terminal()
    });
    let units = match predictions.first().and_then(|case| case.moving) {
        Some(wall) => format!("forces in m g, v = {:e} r sqrt(k_n/m)\n", wall.speed),
        None => "forces in m g\n".to_owned(),
    };
    tables.collect::<Vec<_>>().join("\n") + &units
}

/// One theory of one stack: its name, its yield force, and a remark.
type Line = (&'static str, Option<f64>, String);

fn one_case(case: &Predictions) -> Table {
    let text = |reason: Option<&str>| reason.unwrap_or_default().to_owned();
    let rigid_remark = case.rigid.diverges.then_some("infinite: mu >= mu_c");
    let (elastic, exact) = (&case.elastic, &case.quasistatic);
    let elastic_caution = case.elastic_root.and_then(|root| root.caution());
    let exact_remark = exact.reason.clone().unwrap_or_else(|| "exact".to_owned());
    let exact_remark = match exact.rises_after_onset() && exact.reason.is_none() {
        true => format!("{exact_remark}; the peak, where contact 2-3 opens or shortly before"),
        false => exact_remark,
    };
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
    // The naive, perturbation and elastic theories assume linear springs; the rigid one has no springs.
    let is_linear = case.problem.convention().law.is_linear();
    for (.., remark) in lines[1..4].iter_mut().filter(|_| !is_linear) {
        if remark.is_empty() {
            *remark = "of linear springs".to_owned();
        }
    }
    if exact.rises_after_onset()
        && let Some(onset) = exact.slip_onset
    {
        let force = exact.bottom_force.unwrap_or_default();
        let remark = format!("slip onset, with c = {} m g", digits::<4>(force));
        lines.push(("", Some(onset), remark));
    } else if exact.yield_force.is_none() && exact.floor_slip_force.is_some() {
        let remark = format!("if {} is ignored", exact.event);
        lines.push(("", exact.floor_slip_force, remark));
    }
    if let Some(moving) = case.moving {
        let remark = match moving.excess {
            Some(excess) => format!("peak, {} v above the limit", digits::<7>(excess.peak)),
            None => "what a speed adds is not known here".to_owned(),
        };
        lines.push(("at wall speed v", case.moving_peak(), remark));
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
