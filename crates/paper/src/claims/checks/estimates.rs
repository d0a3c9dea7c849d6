//! Orders of magnitude of the concluding remarks, and the cylinders of the movies.

use super::Check;
use crate::claims::finding::{Finding, relative, violation, worst};
use crate::claims::notation::{FRICTION, STIFFNESS, fixed, number, range, scientific, values};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::yield_force;
use crate::model::{CRITICAL_FRICTION, Stack};
use crate::theory::floor_slip_force;

pub(crate) const CHECKS: &[Check] = &[
    // A line contact of a cylinder of radius r and length l has k_n of order E l.
    Check::theory("epsilon-of-elasticity", |paper| {
        let (modulus, density, radius, length) = (1e6, 1e3, 1e-2, 2e-2);
        let weight = paper.mass(density, radius, length) * GRAVITY;
        let epsilon = paper.epsilon(weight, modulus * length, radius);
        let estimate = radius * density * GRAVITY / modulus;
        let factor = epsilon / estimate;
        let evidence = format!(
            "with $k_n = El$, the order of a line contact's stiffness, $mg/(k_n r) = {factor:.3}L\\rho g/E$ for $L = r$, {:.3} decades off, and with \
             $L = 2r$ {:.3}",
            decades(epsilon, estimate),
            decades(epsilon, 2.0 * estimate)
        );
        Finding::new(decades(epsilon, estimate), 0.0, evidence)
    }),
    Check::theory("epsilon-of-elastomer", |paper| {
        let epsilon = elastomer(paper);
        let found = scientific(epsilon, 3);
        let evidence = format!(
            "$L\\rho g/E = {found}$ for the values given: {:.3} decades off",
            decades(epsilon, paper.elastomer_epsilon)
        );
        Finding::new(decades(epsilon, paper.elastomer_epsilon), 0.0, evidence)
    }),
    Check::theory("elastomer-in-range", |paper| {
        let stiffness = 1.0 / elastomer(paper);
        let outside = worst([
            (paper.lowest_stiffness / stiffness).log10(),
            (stiffness / paper.highest_stiffness).log10(),
            0.0,
        ]);
        let evidence = format!(
            "$1/\\epsilon = {stiffness:.0}$ against the studied {}: {outside:.3} decades outside",
            range(
                STIFFNESS,
                &[paper.lowest_stiffness, paper.highest_stiffness]
            )
        );
        Finding::new(outside, 0.0, evidence)
    }),
    Check::theory("force-of-elastomer", |paper| {
        let force = paper.estimate_mass * GRAVITY / paper.elastomer_epsilon;
        let evidence = format!(
            "$mg/\\epsilon = {force:.1}$ N for $m = {}$ g and $\\epsilon = {}$",
            number(1e3 * paper.estimate_mass),
            number(paper.elastomer_epsilon)
        );
        Finding::new(decades(force, paper.elastomer_force), 0.0, evidence)
    }),
    Check::theory("force-is-inverse-epsilon", |_| {
        let (frictions, stiffness) = ([CRITICAL_FRICTION, 0.28, 0.3, 0.4, 0.5], 1e4);
        let force = |mu| floor_slip_force(&Stack::paper(mu, stiffness)).unwrap_or(f64::NAN);
        let factors = frictions.map(|mu| force(mu) / stiffness);
        let deviation = worst(factors[2..].iter().map(|&factor| decades(factor, 1.0)));
        let evidence = format!(
            "$\\epsilon f/mg$ of the exact quasi-static limit at {}: {} at {}: from ${}$ on the order of magnitude is \
             right up to a factor of {:.1}",
            values(STIFFNESS, &[stiffness]),
            fixed(factors, 3),
            values(FRICTION, &frictions),
            number(frictions[2]),
            10f64.powf(deviation)
        );
        Finding::new(deviation, 0.0, evidence)
    }),
    Check::theory("mass-of-estimates", |paper| {
        let (density, length) = (paper.elastomer_density, paper.elastomer_length);
        let cube = density * length.powi(3);
        let cylinder = paper.mass(density, length, length);
        let evidence = format!(
            "$\\rho L^3 = {:.2}$ g; $\\pi\\rho r^2 l = {:.2}$ g for $r = l = {length}$ cm and {:.2} g for a diameter of \
             {length} cm",
            1e3 * cube,
            1e3 * cylinder,
            0.25e3 * cylinder,
            length = 1e2 * length
        );
        Finding::new(decades(cube, paper.estimate_mass), 1e-9, evidence)
    }),
    // The force implies a modulus of wood, which the paper does not give.
    Check::theory("force-of-wood", |paper| {
        let epsilon = paper.estimate_mass * GRAVITY / paper.wood_force;
        let modulus = paper.elastomer_length * paper.elastomer_density * GRAVITY / epsilon;
        // A cylinder on its side is pressed across the grain: 0.3 to 2 GPa.
        let (across, along) = (1e9, 1e10);
        let evidence = format!(
            "the paper gives no modulus; $mg/\\epsilon = {}$ N implies $\\epsilon = {}$ and $E = {:.2}$ GPa, that of wood across \
             the grain (0.3 to 2 GPa); along the grain ({:.0} GPa) it would be ${}$ N",
            number(paper.wood_force),
            scientific(epsilon, 1),
            modulus / 1e9,
            along / 1e9,
            scientific(paper.wood_force * along / modulus, 0)
        );
        Finding::new(decades(modulus, across), 0.0, evidence)
    }),
    Check::theory("movie-density", |paper| {
        let volume = paper.mass(1.0, paper.movie_radius, paper.movie_width);
        let density = paper.movie_mass / volume;
        let (low, high) = (300.0, 900.0);
        let outside = worst([low / density - 1.0, density / high - 1.0, 0.0]);
        let evidence = format!(
            "$m/(\\pi r^2 w) = {density:.0}$ {UNIT}, {} the {low} to {high} {UNIT} of common dry wood",
            if outside > 0.0 { "outside" } else { "within" }
        );
        Finding::new(outside, 0.0, evidence)
    }),
    Check::theory("stiffness-range", |paper| {
        let decades = (paper.highest_stiffness / paper.lowest_stiffness).log10();
        let stiffnesses = [paper.lowest_stiffness, 1e3, paper.highest_stiffness];
        let mu = 0.3;
        let yields = stiffnesses.map(|stiffness| yield_force(&paper.stack(mu, stiffness)));
        let evidence = format!(
            "the authors' program (compress.c) has springs of ${}$ and ${}$ $mg/r$ times a common factor; the stiffnesses span {decades:.0} decades, in steps of one, and at {} the exact limit has the yield forces {} (in $mg$)",
            number(AUTHORS_SPRINGS[0]),
            number(AUTHORS_SPRINGS[1]),
            values(FRICTION, &[mu]),
            fixed(yields, 2)
        );
        let all_yield = yields.iter().all(|force| force.is_finite());
        let [normal, tangential] = AUTHORS_SPRINGS;
        let ratio = relative(paper.stiffness_ratio, normal / tangential);
        let wrong = worst([(decades - 2.0).abs(), ratio, violation(all_yield)]);
        Finding::new(wrong, 1e-9, evidence)
    }),
];

/// k_n and k_t in compress.c of the authors' repository, in m g/r.
const AUTHORS_SPRINGS: [f64; 2] = [1e2, 4e1];

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;
/// TeX of the unit of a density.
const UNIT: &str = r"$\mathrm{kg/m^3}$";

fn decades(number: f64, printed: f64) -> f64 {
    (number / printed).log10().abs()
}

fn elastomer(paper: &PaperTheory) -> f64 {
    paper.elastomer_length * paper.elastomer_density * GRAVITY / paper.elastomer_modulus
}
