//! The quintic, Eq. (11), and its dominant balances.

use super::Check;
use crate::claims::finding::{Finding, ROUND_OFF, relative, worst};
use crate::claims::multiplied_out::multiplied_out;
use crate::claims::notation::{RATIO, fixed, scientific, size, values};
use crate::claims::truth::{RADIUS, RATIOS, pairs};
use crate::model::CRITICAL_FRICTION;
use crate::theory::bracketed_root;

pub(crate) const CHECKS: &[Check] = &[
    // Compares the constant term, and −z⋆ in the coefficient of z⁴, with the elastic equation multiplied out.
    Check::theory("quintic", |paper| {
        let epsilon: f64 = 1e-2;
        let (mut constant, mut leading) = (Vec::new(), Vec::new());
        for (mu, kappa) in pairs(FRICTIONS, RATIOS) {
            let table = multiplied_out(mu, kappa);
            let truth = table[0][4] * epsilon.powi(4) * RADIUS.powi(5);
            let printed = paper.quintic_constant(mu, kappa, epsilon, RADIUS);
            constant.push(relative(printed, truth));
            let stiff = paper.stiff_displacement(mu, kappa, 1.0);
            leading.push((table[4][0] + stiff).abs());
        }
        let count = constant.len();
        let kappa = paper.stiffness_ratio;
        let coefficient = multiplied_out(CRITICAL_FRICTION, kappa)[0][4];
        let (constant, leading) = (worst(constant), worst(leading));
        let evidence = format!(
            "the elastic equation multiplied out at {count} pairs of $\\mu$ and $\\kappa$, coefficient of $z^5$ made 1: that of \
             $z^4$ at $\\epsilon = 0$ is $-z_\\star$ (deviation {}); the constant term is $c_0\\epsilon^4$ with \
             $c_0 = {coefficient:.4}r^5$ at $\\mu_c$ and {}, off by a factor of up to {:.2} from the printed one. With the \
             bare $\\epsilon^4$ the roots given for $\\beta = 1$ would not follow",
            size(leading, ROUND_OFF),
            values(RATIO, &[kappa]),
            constant + 1.0
        );
        Finding::new(worst([constant, leading]), ROUND_OFF, evidence)
    }),
    // The powers of ε that come with each power of z: z⁵; z⁴ {1, ε}; z³ {ε, ε²}; z² {ε², ε³}; z {ε³, ε⁴}; 1 {ε⁴}.
    Check::theory("quintic-orders", |paper| {
        let last = |power: usize| (power as f64 - paper.quintic_constant_order).abs() < ROUND_OFF;
        let expected = |z_power: usize, epsilon_power: usize| match z_power {
            5 => epsilon_power == 0,
            0 => last(epsilon_power),
            power => epsilon_power == 4 - power || epsilon_power == 5 - power,
        };
        let mut stray = 0.0f64;
        for (mu, kappa) in pairs(FRICTIONS, RATIOS) {
            for (z_power, row) in multiplied_out(mu, kappa).iter().enumerate() {
                for (epsilon_power, coefficient) in row.iter().enumerate() {
                    if !expected(z_power, epsilon_power) {
                        stray = stray.max(coefficient.abs());
                    }
                }
            }
        }
        let found = size(stray, ROUND_OFF);
        let evidence = format!(
            "the elastic equation multiplied out at {} pairs of $\\mu$ and $\\kappa$: largest coefficient of a power of $\\epsilon$ that \
             the form does not have: {found}. (The coefficients depend on $\\kappa$ as well as on $\\mu$.)",
            FRICTIONS.len() * RATIOS.len()
        );
        Finding::new(stray, ROUND_OFF, evidence)
    }),
    Check::theory("balance-exponents", |paper| {
        let kappa = paper.stiffness_ratio;
        let epsilons = [1e-8, 1e-10];
        let [coarse, fine] = epsilons.map(|epsilon| roots(kappa, epsilon));
        let exponents = [0, 1, 2, 3, 4].map(|index| (coarse[index] / fine[index]).log10() / 2.0);
        let (outer, inner) = (paper.larger_exponent, paper.smaller_exponent);
        let expected = [outer, inner, inner, inner, outer];
        let deviation =
            worst([0, 1, 2, 3, 4].map(|index| (exponents[index] - expected[index]).abs()));
        let evidence = format!(
            "the powers of $\\epsilon$ with which all five roots at $\\mu_c$ fall, between {}: {}",
            values(EPSILON, &epsilons),
            fixed(exponents, 3)
        );
        Finding::new(deviation, 1e-3, evidence)
    }),
    Check::theory("balancing-coefficient", |paper| {
        let kappa = paper.stiffness_ratio;
        let epsilon = 1e-10;
        let [_, _, _, _, larger] = roots(kappa, epsilon);
        let needed = -larger * larger / epsilon;
        let table = multiplied_out(CRITICAL_FRICTION, kappa);
        // c₃ ε z³ with c₃ = c₃⁽⁰⁾ + ε c₃⁽¹⁾.
        let bare = paper.balancing_superscript == 0.0;
        let named = table[3][if bare { 1 } else { 2 }];
        let evidence = format!(
            "$z^5$ and $c\\epsilon z^3$ balance at $\\mu_c$ with $c = -z^2/\\epsilon = {needed:.4}$; the quintic has \
             $c_3^{{(0)}} = {:.4}$, $c_3^{{(1)}} = {:.4}$ ({}, $r = 1$), and $c_3^{{(1)}}$ comes with $\\epsilon^2$",
            table[3][1],
            table[3][2],
            values(RATIO, &[kappa])
        );
        Finding::new(relative(named, needed), 1e-3, evidence)
    }),
    Check::theory("larger-roots", |paper| {
        let epsilon = 1e-10;
        let deviations = RATIOS.map(|kappa| {
            let [negative, .., positive] = roots(kappa, epsilon);
            let printed = paper.critical_displacement(kappa, epsilon, 1.0);
            worst([relative(printed, positive), relative(-printed, negative)])
        });
        let largest = worst(deviations);
        let evidence = format!(
            "largest and smallest root of the multiplied-out equation at $\\mu_c$, {}, {}: relative difference at most ${}$ (it \
             falls as $\\sqrt\\epsilon$)",
            values(EPSILON, &[epsilon]),
            values(RATIO, &RATIOS),
            scientific(largest, 1)
        );
        Finding::new(largest, 1e-3, evidence)
    }),
    Check::theory("smaller-roots", |paper| {
        let epsilon = 1e-10;
        let [_, lowest, near_one, beyond_one, _] =
            roots(paper.stiffness_ratio, epsilon).map(|root| root / epsilon);
        let printed = 1.0 / (paper.small_root_factor * paper.critical_friction);
        let deviation = worst([
            relative(printed, lowest),
            (near_one - 1.0).abs(),
            (beyond_one - 1.0).abs(),
        ]);
        let evidence = format!(
            "roots of order $\\epsilon$ at $\\mu_c$, {}: $z/(\\epsilon r)$ is {} (the latter two meet at 1); \
             $1/(4\\mu_c) = {printed:.5}$",
            values(EPSILON, &[epsilon]),
            fixed([lowest, near_one, beyond_one], 5)
        );
        Finding::new(deviation, 1e-3, evidence)
    }),
    Check::theory("only-admissible-root", |paper| {
        let epsilon = 1e-6;
        let lowest = paper.lowest_displacement * epsilon;
        let roots = roots(paper.stiffness_ratio, epsilon).into_iter();
        let admissible = roots.filter(|&root| root >= lowest).count();
        let evidence = format!(
            "{admissible} of the five roots at $\\mu_c$, {}, has $z \\ge 3\\epsilon r/2$",
            values(EPSILON, &[epsilon])
        );
        Finding::new((admissible as f64 - 1.0).abs(), 0.0, evidence)
    }),
];

/// TeX of ε.
const EPSILON: &str = r"\epsilon";
const FRICTIONS: [f64; 5] = [0.1, 0.2, CRITICAL_FRICTION, 0.3, 0.5];

/// P(z) at μ_c.
fn polynomial(kappa: f64, epsilon: f64, z: f64) -> f64 {
    let mut table = multiplied_out(CRITICAL_FRICTION, kappa);
    // z⋆ is 0 at μ_c; its rounding error would be magnified by 1/ε².
    table[4][0] = 0.0;
    horner(&table.map(|coefficients| horner(&coefficients, epsilon)), z)
}

/// Evaluates the polynomial with these coefficients, lowest power first, at `x`.
fn horner(coefficients: &[f64], x: f64) -> f64 {
    let highest_first = coefficients.iter().rev();
    highest_first.fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// Returns the five roots at μ_c, smallest first: the negative one, the three of order ε, and the large positive one.
fn roots(kappa: f64, epsilon: f64) -> [f64; 5] {
    let scale = (epsilon / (CRITICAL_FRICTION * (1.0 + 4.0 * kappa * CRITICAL_FRICTION))).sqrt();
    let between = |low: f64, high: f64| {
        bracketed_root(|z| polynomial(kappa, epsilon, z), low, high).unwrap_or(f64::NAN)
    };
    [
        between(-1.5 * scale, -0.5 * scale),
        between(0.8 * epsilon, 0.96 * epsilon),
        between(0.96 * epsilon, epsilon),
        between(epsilon, 1.04 * epsilon),
        between(0.5 * scale, 1.5 * scale),
    ]
}
