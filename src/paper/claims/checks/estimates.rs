//! Orders of magnitude of the concluding remarks, and the cylinders of the movies.

use super::Check;
use crate::model::{CRITICAL_FRICTION, ContactConvention, Stack};
use crate::paper::claims::finding::{Finding, list, violation, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::theory::{floor_slip_force, quasistatic_limit};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("epsilon-of-elasticity", epsilon_of_elasticity),
    Check::theory("epsilon-of-elastomer", epsilon_of_elastomer),
    Check::theory("elastomer-in-range", elastomer_in_range),
    Check::theory("force-of-elastomer", force_of_elastomer),
    Check::theory("force-is-inverse-epsilon", force_is_inverse_epsilon),
    Check::theory("mass-of-estimates", mass_of_estimates),
    Check::theory("force-of-wood", force_of_wood),
    Check::theory("movie-density", movie_density),
    Check::theory("stiffness-range", stiffness_range),
];

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

fn decades(number: f64, printed: f64) -> f64 {
    (number / printed).log10().abs()
}

/// A line contact of a cylinder of radius r and length l has k_n of order E l.
fn epsilon_of_elasticity(paper: &PaperTheory) -> Finding {
    let (modulus, density, radius, length) = (1e6, 1e3, 1e-2, 2e-2);
    let weight = paper.mass(density, radius, length) * GRAVITY;
    let epsilon = paper.epsilon(weight, modulus * length, radius);
    let estimate = radius * density * GRAVITY / modulus;
    let factor = epsilon / estimate;
    let evidence = format!(
        "with k_n = E l, the order of a line contact's stiffness, mg/(k_n r) = {factor:.3} L rho g/E for L = r: {:.2} decades",
        decades(epsilon, estimate)
    );
    Finding::new(decades(epsilon, estimate), 0.0, evidence)
}

fn elastomer(paper: &PaperTheory) -> f64 {
    paper.elastomer_length * paper.elastomer_density * GRAVITY / paper.elastomer_modulus
}

fn epsilon_of_elastomer(paper: &PaperTheory) -> Finding {
    let epsilon = elastomer(paper);
    let evidence = format!("L rho g/E = {epsilon:.3e} for the values given");
    Finding::new(decades(epsilon, paper.elastomer_epsilon), 0.0, evidence)
}

fn elastomer_in_range(paper: &PaperTheory) -> Finding {
    let stiffness = 1.0 / elastomer(paper);
    let outside = worst([
        (paper.lowest_stiffness / stiffness).log10(),
        (stiffness / paper.highest_stiffness).log10(),
        0.0,
    ]);
    let evidence = format!(
        "1/epsilon = {stiffness:.0} against the studied {:.0} to {:.0}: {outside:.3} decades outside",
        paper.lowest_stiffness, paper.highest_stiffness
    );
    Finding::new(outside, 0.0, evidence)
}

fn force_of_elastomer(paper: &PaperTheory) -> Finding {
    let force = paper.estimate_mass * GRAVITY / paper.elastomer_epsilon;
    let evidence = format!("mg/epsilon = {force:.1} N for m = 1 g and epsilon = 1e-4");
    Finding::new(decades(force, paper.elastomer_force), 0.0, evidence)
}

fn force_is_inverse_epsilon(_: &PaperTheory) -> Finding {
    let frictions = [CRITICAL_FRICTION, 0.28, 0.3, 0.4, 0.5];
    let factors =
        frictions.map(|mu| floor_slip_force(&Stack::paper(mu, 1e4)).unwrap_or(f64::NAN) / 1e4);
    let evidence = format!(
        "epsilon f/mg of the exact quasi-static limit at 1/epsilon = 1e4: {} at mu = mu_c, 0.28, 0.3, 0.4, 0.5: the order of \
         magnitude is right from 0.3 on, up to a factor of 5",
        list(factors.map(|factor| format!("{factor:.3}")))
    );
    let deviation = worst(factors[2..].iter().map(|&factor| decades(factor, 1.0)));
    Finding::new(deviation, 0.0, evidence)
}

fn mass_of_estimates(paper: &PaperTheory) -> Finding {
    let cube = paper.elastomer_density * paper.elastomer_length.powi(3);
    let cylinder = paper.mass(
        paper.elastomer_density,
        paper.elastomer_length,
        paper.elastomer_length,
    );
    let evidence = format!(
        "rho L^3 = {:.2} g; pi rho r^2 l = {:.2} g for r = l = 1 cm and {:.2} g for a diameter of 1 cm",
        1e3 * cube,
        1e3 * cylinder,
        0.25e3 * cylinder
    );
    Finding::new(decades(cube, paper.estimate_mass), 1e-9, evidence)
}

/// The force implies a modulus of wood, which the paper does not give.
fn force_of_wood(paper: &PaperTheory) -> Finding {
    let epsilon = paper.estimate_mass * GRAVITY / paper.wood_force;
    let modulus = paper.elastomer_length * paper.elastomer_density * GRAVITY / epsilon;
    // A cylinder on its side is pressed across the grain: 0.3 to 2 GPa.
    let across = 1e9;
    let evidence = format!(
        "the paper gives no modulus; mg/epsilon = 1e5 N implies epsilon = {epsilon:.1e} and E = {:.2} GPa, that of wood across the grain (0.3 to 2 GPa); \
         along the grain (10 GPa) it would be 1e6 N",
        modulus / 1e9
    );
    Finding::new(decades(modulus, across), 0.0, evidence)
}

fn movie_density(paper: &PaperTheory) -> Finding {
    let volume = paper.mass(1.0, paper.movie_radius, paper.movie_width);
    let density = paper.movie_mass / volume;
    let evidence = format!(
        "m/(pi r^2 w) = {density:.0} kg/m^3, within the 300 to 900 kg/m^3 of common dry wood"
    );
    let outside = worst([300.0 / density - 1.0, density / 900.0 - 1.0, 0.0]);
    Finding::new(outside, 0.0, evidence)
}

fn stiffness_range(paper: &PaperTheory) -> Finding {
    let decades = (paper.highest_stiffness / paper.lowest_stiffness).log10();
    let yields = [paper.lowest_stiffness, 1e3, paper.highest_stiffness].map(|stiffness| {
        quasistatic_limit(&paper.stack(0.3, stiffness), &ContactConvention::PAPER)
            .yield_force
            .unwrap_or(f64::NAN)
    });
    let evidence = format!(
        "all three have a yield force in the exact limit at mu = 0.3: {:.2}, {:.2}, {:.2} mg; they span {decades:.0} decades, in steps of one",
        yields[0], yields[1], yields[2]
    );
    let all_yield = yields.iter().all(|force| force.is_finite());
    let wrong = worst([(decades - 2.0).abs(), violation(all_yield)]);
    Finding::new(wrong, 1e-9, evidence)
}
