//! The singular perturbation, Eqs. (14) to (17), and appendix B.

use super::Check;
use crate::claims::finding::{Finding, imbalance, relative, worst};
use crate::claims::notation::{
    FRICTION, RATIO, STIFFNESS, fixed, number, range, scientific, values,
};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::{RADIUS, RATIOS, elastic_displacement, pairs, stack};
use crate::model::CRITICAL_FRICTION;

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("remainder", |paper| {
        let frictions = [0.2, 0.25, 0.3, 0.5];
        let away = frictions.map(|mu| order(paper, mu, 1e-4, 1e-5));
        let at = order(paper, CRITICAL_FRICTION, 1e-5, 1e-7);
        let evidence = format!(
            "$z(z - z_\\star) - \\epsilon r^2\\Phi$ at the root of the elastic equation falls as $\\epsilon$ to the power {} at {}, but \
             {at:.2} at $\\mu_c$, where $\\alpha$ is of order {ROOT_OF_EPSILON}",
            fixed(away, 2),
            values(FRICTION, &frictions)
        );
        let away = worst(away.map(|order| (order - paper.remainder_order).abs()));
        let at = (at - paper.remainder_order_at_transition).abs();
        Finding::new(worst([away, at]), 0.05, evidence)
    }),
    Check::theory("coefficient", |paper| {
        let frictions = [0.1, 0.15, 0.2, 0.25, CRITICAL_FRICTION, 0.3, 0.4, 0.5, 0.7];
        let stiffness = 1e8;
        let largest = worst(pairs(frictions, RATIOS).map(|(mu, kappa)| {
            let epsilon = 1.0 / stiffness;
            let alpha = epsilon / root(mu, kappa, epsilon);
            // F(μ, α → 0), with α no smaller than rounding allows.
            let truth = true_quotient(mu, kappa, alpha.max(1e-6));
            relative(paper.coefficient(mu, kappa), truth)
        }));
        let evidence = format!(
            "$\\Phi$ against {QUOTIENT} at the elastic equation's own $\\alpha$ for {}, {}, {}: largest relative difference ${}$ \
             (it falls with $\\epsilon$)",
            values(STIFFNESS, &[stiffness]),
            range(FRICTION, &frictions),
            values(RATIO, &RATIOS),
            scientific(largest, 0)
        );
        Finding::new(largest, 1e-3, evidence)
    }),
    Check::theory("product-quotient", |paper| {
        let deviations = points().map(|(mu, kappa, alpha)| {
            let printed = paper.product_quotient(mu, kappa, alpha);
            relative(printed, true_quotient(mu, kappa, alpha))
        });
        let compared = format!("$F$ against {QUOTIENT} of the springs' own {PRODUCT}");
        Finding::identity(deviations, &compared)
    }),
    // 𝒟 and ℰ are smooth in α: D and E have limits for α → 0.
    Check::theory("difference-quotients", |paper| {
        let alpha = 1e-5;
        let change = |function: &dyn Fn(f64) -> f64| {
            let quotient = |alpha: f64| (function(alpha) - function(0.0)) / alpha;
            (quotient(alpha) - quotient(-alpha)).abs() / (1.0 + quotient(alpha).abs())
        };
        let largest = worst(pairs(FRICTIONS, RATIOS).map(|(mu, kappa)| {
            worst([
                change(&|alpha| paper.geometry(mu, alpha)),
                change(&|alpha| paper.compliance(mu, kappa, alpha)),
            ])
        }));
        let evidence = format!(
            "$D$ and $E$ at $\\alpha = {0}$ and $-{0}$ differ by at most ${1}$ of $1 + \\lvert D\\rvert$ and $1 + \\lvert E\\rvert$ at {2} pairs of $\\mu$ and $\\kappa$: they are regular at \
             $\\alpha = 0$",
            number(alpha),
            scientific(largest, 0),
            FRICTIONS.len() * RATIOS.len()
        );
        Finding::new(largest, 1e-2, evidence)
    }),
    Check::theory("perturbative-solution", |paper| {
        let frictions = [0.1, 0.2, 0.25, CRITICAL_FRICTION, 0.3, 0.5];
        let deviations = pairs(frictions, RATIOS).flat_map(|(mu, kappa)| {
            [1e-2, 1e-4].map(|epsilon| {
                let z = 0.5 * epsilon * paper.perturbative_load(mu, kappa, epsilon);
                let stiff = paper.stiff_displacement(mu, kappa, 1.0);
                let source = epsilon * paper.coefficient(mu, kappa);
                imbalance(&[z * z, -z * stiff, -source])
            })
        });
        let compared =
            r"$z = \epsilon r(f + 3mg)/(2mg)$ put into $z(z - z_\star) = \epsilon r^2\Phi$";
        Finding::identity(deviations, compared)
    }),
    // z = z⋆ + α r (ℰ(0) D + 𝒟(0) E + α D E).
    Check::theory("expansion", |paper| {
        let deviations = points().map(|(mu, kappa, alpha)| {
            let z = RADIUS * paper.geometry(mu, alpha) * paper.compliance(mu, kappa, alpha);
            let stiff = paper.stiff_displacement(mu, kappa, RADIUS);
            let added = alpha * RADIUS * paper.product_quotient(mu, kappa, alpha);
            imbalance(&[stiff, added, -z])
        });
        let compared = r"$r\mathcal{D}\mathcal{E}$ against $z_\star + \alpha rF$, $r$ not 1";
        Finding::identity(deviations, compared)
    }),
    // z(z − z⋆) = ε r² F(μ, α) at roots of the elastic equation.
    Check::theory("quadratic", |paper| {
        let stiffness = 1e2;
        let epsilon = 1.0 / stiffness;
        let deviations = pairs(FRICTIONS, RATIOS).map(|(mu, kappa)| {
            let z = RADIUS * root(mu, kappa, epsilon);
            let alpha = epsilon * RADIUS / z;
            let stiff = paper.stiff_displacement(mu, kappa, RADIUS);
            let source = epsilon * RADIUS * RADIUS * paper.product_quotient(mu, kappa, alpha);
            imbalance(&[z * z, -z * stiff, -source])
        });
        let at = values(STIFFNESS, &[stiffness]);
        let compared = format!("roots of the elastic equation at {at}, $r$ not 1");
        Finding::identity(deviations, &compared)
    }),
    Check::theory("limiting-alpha", |paper| {
        let stiffness = 1e8;
        let epsilon = 1.0 / stiffness;
        let alpha = |mu: f64| epsilon / root(mu, paper.stiffness_ratio, epsilon);
        let deviation = |mu: f64| (alpha(mu) - paper.limiting_alpha(mu)).abs();
        let frictions = [0.1, 0.15, 0.2, 0.25, 0.28, 0.3, 0.5];
        let away = worst(frictions.map(deviation));
        let at = deviation(CRITICAL_FRICTION);
        let evidence = format!(
            "$\\alpha$ of the elastic equation at {}: within ${}$ of the limit at {} frictions ({}), ${}$ at $\\mu_c$, where it \
             vanishes as {ROOT_OF_EPSILON}",
            values(STIFFNESS, &[stiffness]),
            scientific(away, 0),
            frictions.len(),
            range(FRICTION, &frictions),
            scientific(at, 0)
        );
        Finding::new(worst([away, at]), 1e-3, evidence)
    }),
];

/// TeX of ε to the power 1/2.
const ROOT_OF_EPSILON: &str = r"$\epsilon^{1/2}$";
/// TeX of the product of the script letters.
const PRODUCT: &str = r"$\mathcal{D}\mathcal{E}$";
/// TeX of their difference quotient.
const QUOTIENT: &str = r"$[\mathcal{D}\mathcal{E}(\alpha) - \mathcal{D}\mathcal{E}(0)]/\alpha$";
const FRICTIONS: [f64; 5] = [0.1, 0.2, CRITICAL_FRICTION, 0.3, 0.5];

fn root(mu: f64, kappa: f64, epsilon: f64) -> f64 {
    elastic_displacement(&stack(mu, kappa, epsilon))
}

/// (𝒟ℰ(α) − 𝒟ℰ(0))/α with 𝒟 and ℰ in terms of T = μ/(1 − α), as they follow from the springs.
fn true_quotient(mu: f64, kappa: f64, alpha: f64) -> f64 {
    let displacement = |alpha: f64| {
        let u = 1.0 - alpha;
        let tangent = mu / u;
        let square = tangent * tangent;
        (square + 2.0 * 3f64.sqrt() * tangent - 1.0)
            / (u * tangent * (1.0 + square))
            / (1.0 + kappa * (1.0 + square))
    };
    (displacement(alpha) - displacement(0.0)) / alpha
}

/// Returns the order in ε of z(z − z⋆) − ε r² Φ at the root of the elastic equation.
fn order(paper: &PaperTheory, mu: f64, coarse: f64, fine: f64) -> f64 {
    let kappa = paper.stiffness_ratio;
    let left = |epsilon: f64| {
        let z = root(mu, kappa, epsilon);
        // z(z − z⋆) = ε F(μ, α), so that the remainder is ε (F − Φ).
        let alpha = epsilon / z;
        epsilon * (true_quotient(mu, kappa, alpha) - paper.coefficient(mu, kappa))
    };
    (left(coarse) / left(fine)).abs().ln() / (coarse / fine).ln()
}

/// Points (μ, κ, α) with α large enough that difference quotients keep their digits.
fn points() -> impl Iterator<Item = (f64, f64, f64)> {
    pairs(FRICTIONS, RATIOS)
        .flat_map(|(mu, kappa)| [0.05, 0.2, 0.4, 0.6].map(|alpha| (mu, kappa, alpha)))
}
