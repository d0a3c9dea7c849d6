//! The paper's statements on its simulations, checked with the native DEM, which has the paper's contact law, and
//! with the published data.

use super::Check;
use crate::claims::finding::{Finding, relative, violation, worst};
use crate::claims::notation::{FRICTION, list, number, percent, scientific, stack, values};
use crate::claims::simulations::Simulations;
use crate::claims::truth::yield_force;
use crate::model::{CRITICAL_FRICTION, ContactConvention};
use crate::reproduction::{
    FAST_WALL, FITTED_FROM, SCALING_FRICTIONS, WALL_SPEEDS, convergence_stack, exponent_at,
    force_series_stack,
};
use crate::study::yield_force::PAPER_TIME_STEP;

pub(crate) const CHECKS: &[Check] = &[
    // f(t) rises, has one maximum, and falls.
    Check::simulations("force-series", |_, runs| {
        let rows = &runs.series.rows;
        let numbered = rows.iter().enumerate();
        let peak = numbered.max_by(|left, right| left.1.1.total_cmp(&right.1.1));
        let (index, &(_, highest)) = peak.ok_or_else(|| missing("f(t)"))?;
        let (mut so_far, mut drop) = (0.0f64, 0.0f64);
        for &(_, force) in &rows[..index] {
            drop = drop.max(so_far - force);
            so_far = so_far.max(force);
        }
        let last = rows.last().map_or(f64::NAN, |row| row.1);
        let evidence = format!(
            "{} at {}, {}: $f$ rises to ${highest:.4}mg${} and then falls to ${last:.3}mg$ in {} rows{}",
            runs.who,
            stack(&force_series_stack()),
            speed(runs.series.wall_speed),
            match drop > 0.0 {
                true => format!(
                    ", with a fall of ${}$ of it on the way,",
                    scientific(drop / highest, 1)
                ),
                false => " without a fall on the way".to_owned(),
            },
            rows.len(),
            runs.labels(&force_series_stack())
        );
        let deviation = worst([drop / highest, violation(last < 0.9 * highest)]);
        Ok(Finding::new(deviation, CIRCLE, evidence))
    }),
    // Compares the peak at the paper's speed with the exact quasi-static limit, for the stack whose f(t) the paper
    // shows.
    Check::simulations("peak-is-quasistatic", |_, runs| {
        let series = &runs.series;
        let forces = series.peak_force.zip(series.limit);
        let (peak, limit) = forces.ok_or_else(|| missing("f(t)"))?;
        let evidence = format!(
            "{} at {}, {}, {}: peak ${peak:.6}mg${}, exact quasi-static limit ${limit:.6}mg$: {} of $f${}",
            runs.who,
            stack(&force_series_stack()),
            speed(series.wall_speed),
            time_step(series.time_step),
            runs.peak_source,
            percent(peak / limit - 1.0, 4),
            runs.labels(&force_series_stack())
        );
        Ok(Finding::new(relative(peak, limit), CIRCLE, evidence))
    }),
    Check::simulations("converges-with-speed", |paper, runs| {
        let speeds = [1e-4, 1e-5, paper.compression_speed];
        let excesses = speeds.map(|speed| excess(runs, speed));
        let [Some(fast), Some(middle), Some(slow)] = excesses else {
            return Err(missing("the convergence study"));
        };
        let evidence = format!(
            "{} at {}, {}: peak against the exact quasi-static limit, in parts of $f$, {}{}",
            runs.who,
            stack(&convergence_stack()),
            time_step(PAPER_TIME_STEP),
            percents(runs, &WALL_SPEEDS),
            runs.labels(&convergence_stack())
        );
        let shrinks = fast.abs() > middle.abs() && middle.abs() > slow.abs();
        Ok(Finding::statement(shrinks, evidence))
    }),
    Check::simulations("compression-speed", |paper, runs| {
        let excess = excess(runs, paper.compression_speed);
        let excess = excess.ok_or_else(|| missing("this wall speed"))?;
        let evidence = format!(
            "{} at {}, {}: peak against the exact quasi-static limit, in parts of $f$, {}{}",
            runs.who,
            stack(&convergence_stack()),
            time_step(PAPER_TIME_STEP),
            percents(runs, &WALL_SPEEDS[2..]),
            runs.labels(&convergence_stack())
        );
        Ok(Finding::new(excess.abs(), CIRCLE, evidence))
    }),
    Check::simulations("time-step", |paper, runs| {
        let peak = |step: f64| at(&runs.time_steps, step);
        let peaks = peak(paper.time_step).zip(peak(0.1 * paper.time_step));
        let (usual, finer) = peaks.ok_or_else(|| missing("these time steps"))?;
        let coarsest = 0.1;
        let coarse = peak(coarsest).map_or_else(String::new, |coarse| {
            let off = scientific(relative(coarse, finer), 1);
            format!("; even at {} it is ${off}$ off", time_step(coarsest))
        });
        let change = relative(usual, finer);
        let evidence = format!(
            "{} at {}, {}: the peak changes by ${}$ of it between {} and a tenth of that step{coarse}{}",
            runs.who,
            stack(&convergence_stack()),
            speed(FAST_WALL),
            scientific(change, 1),
            time_step(paper.time_step),
            runs.labels(&convergence_stack())
        );
        Ok(Finding::new(change, CIRCLE, evidence))
    }),
    Check::theory("leapfrog", |paper| {
        let ratio = paper.time_step
            / paper
                .stack(0.2, 1e4)
                .longest_time_step(&ContactConvention::PAPER);
        let evidence = format!(
            "a leapfrog step is stable up to $2/\\omega$ of the stiffest mode of the stack; {} is ${}$ of the longest safe \
             step",
            time_step(paper.time_step),
            scientific(ratio, 1)
        );
        Finding::new(if ratio <= 1.0 { 0.0 } else { ratio }, 0.0, evidence)
    }),
    Check::simulations("agrees-with-perturbation", |paper, runs| {
        let rows = runs.over_friction.iter();
        let kappa = paper.stiffness_ratio;
        let compared = rows.map(|&[mu, stiffness, force]| {
            let printed = paper.perturbative_load(mu, kappa, 1.0 / stiffness);
            (relative(printed, force + 3.0), mu, stiffness)
        });
        let compared: Vec<_> = compared.collect();
        let rows = compared.iter();
        let farthest = rows.max_by(|left, right| left.0.total_cmp(&right.0));
        let &(largest, mu, stiffness) = farthest.ok_or_else(|| missing("Fig. 2(a)"))?;
        let near = compared.iter().filter(|row| row.1 <= CRITICAL_FRICTION);
        let near = worst(near.map(|row| row.0));
        let evidence = format!(
            "{}, {} stacks at the stiffnesses of Fig. 2(a){}, against Eq. (17): $f + 3mg$ differs by at \
             most {:.2} % ({}), {:.2} % up to $\\mu_c$. The distance does not vanish for stiff cylinders above $\\mu_c$",
            runs.who,
            compared.len(),
            runs.read,
            100.0 * largest,
            stack(&paper.stack(mu, stiffness)),
            100.0 * near
        );
        Ok(Finding::new(largest, 1e-3, evidence))
    }),
    Check::simulations("runs-approach-rigid-limit", |paper, runs| {
        let rows = runs.over_stiffness.iter();
        let below = rows.filter(|row| row[0] < CRITICAL_FRICTION);
        let below = below.map(|&[mu, stiffness, force]| {
            let rigid = paper.rigid_yield_force(mu);
            (stiffness, (force + 3.0) / (rigid + 3.0) - 1.0)
        });
        let mut below: Vec<(f64, f64)> = below.collect();
        below.sort_by(|left, right| left.0.total_cmp(&right.0));
        let &(stiffness, last) = below.last().ok_or_else(|| missing("Fig. 2(b)"))?;
        // Largest amount by which stiffer cylinders are farther off than softer ones.
        let (mut closest, mut receding) = (f64::INFINITY, 0.0f64);
        for &(_, off) in &below {
            receding = receding.max(off.abs() - closest);
            closest = closest.min(off.abs());
        }
        let crossed = below
            .windows(2)
            .find(|pair| pair[0].1 < 0.0 && pair[1].1 > 0.0);
        let evidence = format!(
            "{} at {}: $f + 3mg$ is {} off $f_0 + 3mg$ at ${}$, and {} off at ${}${}; at $\\mu_c$ and above it grows without bound (see the \
             exponents)",
            runs.who,
            values(FRICTION, &SCALING_FRICTIONS[..1]),
            percent(below[0].1, 2),
            number(below[0].0),
            percent(last, 3),
            number(stiffness),
            crossed.map_or_else(String::new, |pair| format!(
                ", having passed it between ${}$ and ${}$, which no slow wall does",
                number(pair[0].0),
                number(pair[1].0)
            ))
        );
        let deviation = worst([last.abs(), receding]);
        Ok(Finding::new(deviation, 1e-3, evidence))
    }),
    Check::simulations("runs-scale", |paper, runs| {
        let [mut listed, mut stiffest] = [Vec::new(), Vec::new()];
        let mut deviations = Vec::new();
        for own in &runs.exponents {
            let printed = exponent_at(own.friction, [0.0, paper.scaling_at, paper.scaling_above]);
            // At the fitted stiffnesses the exact limit itself has other exponents; for stiff cylinders it has the
            // printed ones.
            let farther = (own.exponent - printed).abs() - (own.exact - printed).abs();
            let [soft, stiff] = STIFF.map(|stiffness| {
                libm::log(yield_force(&paper.stack(own.friction, stiffness)) + 3.0)
            });
            let asymptotic = (stiff - soft) / libm::log(STIFF[1] / STIFF[0]);
            deviations.extend([farther.max(0.0), (asymptotic - printed).abs()]);
            stiffest.push(format!("${asymptotic:.4}$"));
            let uncertainty = own.uncertainty.map_or_else(String::new, |uncertainty| {
                format!(" \\pm {}", scientific(uncertainty, 0))
            });
            listed.push(format!(
                "${:.4}{uncertainty}$ (exact limit ${:.4}$) at {}",
                own.exponent,
                own.exact,
                values(FRICTION, &[own.friction])
            ));
        }
        if listed.len() < 3 {
            return Err(missing("Fig. 2(b)"));
        }
        let evidence = format!(
            "slopes of $\\ln(f + 3mg)$ over $\\ln(k_n r/mg)$, {}, fitted from ${}$ on: {}; from ${}$ to ${}$ the exact limit \
             has {}, and the paper 0 below $\\mu_c$, {} at $\\mu_c$ and {} above",
            runs.who,
            number(FITTED_FROM),
            list(listed),
            number(STIFF[0]),
            number(STIFF[1]),
            list(stiffest),
            paper.scaling_at,
            paper.scaling_above
        );
        Ok(Finding::new(worst(deviations), 2e-3, evidence))
    }),
];

/// Stiffnesses between which the exact limit has the exponents for ε → 0, to a few digits.
const STIFF: [f64; 2] = [1e7, 1e9];

/// Largest difference that "converged", "unchanged" and "is" can mean for a yield force in the figure on convergence:
/// half the height of its circles, 6 of 43.58 points for 0.1 m g (figS3b.pdf of the authors' repository), as a part
/// of f there.
const CIRCLE: f64 = 6.0 / 435.8 / 4.880;

/// Says why a check cannot be made.
fn missing(name: &str) -> String {
    format!("nothing was run or published of {name}")
}

/// Returns the number that belongs to this `value` of a setting.
fn at(points: &[(f64, f64)], value: f64) -> Option<f64> {
    let mut points = points.iter();
    let own = points.find(|(setting, _)| relative(*setting, value) < 1e-9);
    own.map(|&(_, number)| number)
}

/// Returns the excess of the peak over the limit at a wall speed.
fn excess(runs: &Simulations, speed: f64) -> Option<f64> {
    at(&runs.wall_speeds, speed)
}

fn percents(runs: &Simulations, speeds: &[f64]) -> String {
    list(speeds.iter().map(|&speed| match excess(runs, speed) {
        Some(excess) => format!("{} at {}", percent(excess, 3), self::speed(speed)),
        None => format!("not run at {}", self::speed(speed)),
    }))
}

/// Writes a speed of the compressing wall.
fn speed(speed: f64) -> String {
    format!(r"$v_{{\mathrm{{com}}}} = {}r\sqrt{{k_n/m}}$", number(speed))
}

fn time_step(step: f64) -> String {
    format!(r"$\Delta t = {}\sqrt{{m/k_n}}$", number(step))
}
