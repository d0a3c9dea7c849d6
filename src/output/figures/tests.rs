//! Made-up runs, so that every mark can be counted.

use super::style::Mark;
use super::*;
use crate::code::{Code, Interrupt};
use crate::model::{Power, Stack};
use crate::paper::reproduction::{
    Convergence, ConvergencePoint, Curves, Exponent, ForceSeries, Laws, Spheres, TheoryPoint,
    snapshots,
};
use crate::study::preparation::{PreparationRow, PreparationStudy};
use crate::study::regimes::Survey;
use crate::study::yield_force::{Judgement, YieldForce, plan};
use crate::study::{Grounds, Judged, Source, Verdict};
use crate::theory::RegimeMap;

const FRICTIONS: [f64; 4] = [0.1, 0.2, 0.3, 0.5];

fn judgement(code: Code, mu: f64, yield_force: Option<f64>) -> Judgement {
    let mut study = plan(code, &Stack::paper(mu, 100.0), code.convention());
    study.limit.yield_force = Some(4.0);
    study.model_form = Some(-0.01);
    let mut grounds = Grounds::new();
    if yield_force.is_some() {
        grounds.compare(1e-8, 1e-7, 1e-7, None);
    }
    Judged {
        study,
        code,
        version: "1".to_owned(),
        source: Source::Live,
        arms_are_measured: true,
        finding: Some(YieldForce {
            runs: Vec::new(),
            slip: None,
            peak: None,
            peak_uncertainty: None,
            force: yield_force.map(|force| (force, 1e-7 * force)),
        }),
        grounds,
    }
}

/// LIGGGHTS at two pushes, of which one has failed.
fn preparation() -> PreparationStudy {
    let row = |push: f64, force: Option<f64>| PreparationRow {
        code: Code::named("liggghts").unwrap(),
        convention_of: Code::named("liggghts").unwrap(),
        push: Some(push),
        limit_force: None,
        contact_force: force.map(|_| 0.1),
        contact_uncertainty: None,
        yield_force: force,
        uncertainty: None,
        estimator: None,
        note: None,
        provenances: Vec::new(),
    };
    PreparationStudy {
        stack: Stack::paper(0.2, 1e2),
        exact_force: Some(4.318),
        predicted_critical_push: 0.0053,
        critical_push: None,
        rows: vec![row(0.0, Some(4.3)), row(0.01, None)],
    }
}

/// Every code at every friction, with LAMMPS having failed.
fn judgements() -> Vec<Judgement> {
    let codes = Code::of_power(Power::Linear).into_iter();
    let rows = codes.flat_map(|code| {
        let force = (code != Code::named("lammps").unwrap()).then_some(4.0);
        FRICTIONS.map(|mu| judgement(code, mu, force))
    });
    rows.collect()
}

fn study(force: Option<f64>) -> Convergence {
    let point = |wall_speed, time_step| ConvergencePoint {
        code: Code::named("liggghts").unwrap(),
        wall_speed,
        time_step,
        slip_force: force.map(|force| force + time_step),
        peak_force: force.map(|force| force + 2.0 * time_step),
        limit: Some(4.0),
        remark: None,
    };
    Convergence {
        wall_speeds: vec![point(1e-6, 1e-3), point(1e-4, 1e-3)],
        time_steps: vec![point(1e-3, 1e-1), point(1e-3, 1e-2), point(1e-3, 1e-3)],
    }
}

fn series(rows: Vec<(f64, f64)>) -> ForceSeries {
    let peak_force = (!rows.is_empty()).then_some(4.02);
    ForceSeries {
        rows,
        slip_force: peak_force.map(|_| 4.001),
        peak_force,
        limit: Some(4.0),
        wall_speed: 1e-6,
        time_step: 1e-3,
    }
}

fn curves() -> Curves {
    let point = |mu, stiffness| TheoryPoint {
        mu,
        stiffness,
        rigid: None,
        naive: Some(4.4),
        perturbation: Some(4.1),
        elastic: Some(4.01),
        exact: (mu < 0.5).then_some(4.0),
    };
    Curves {
        over_friction: FRICTIONS.map(|mu| point(mu, 100.0)).into(),
        over_stiffness: [1e1, 1e3].map(|stiffness| point(0.3, stiffness)).into(),
        model_form: Vec::new(),
    }
}

fn exponent() -> Exponent {
    Exponent {
        code: Code::NATIVE,
        power: Power::Linear,
        mu: 0.3,
        exponent: 0.989_588,
        uncertainty: 2.5e-6,
        exact: 0.989_587,
        asymptotic: 1.0,
        points: 4,
        verdict: Verdict::Agrees,
    }
}

fn reproduction(judgements: Vec<Judgement>) -> Reproduction {
    let empty = judgements.is_empty();
    let rows = vec![(0.0, 0.0), (1e4, 4.0), (1.001e4, 4.02), (1.01e4, 3.0)];
    Reproduction {
        probes: Vec::new(),
        scaling: judgements.clone(),
        yield_curves: judgements,
        exponents: if empty { Vec::new() } else { vec![exponent()] },
        laws: Laws::default(),
        literal: Vec::new(),
        convergence: study((!empty).then_some(4.1)),
        force_series: series(if empty { Vec::new() } else { rows }),
        preparation: vec![preparation()],
        snapshots: snapshots(&Interrupt::new()).unwrap().unwrap(),
        trajectories: Vec::new(),
        maps: RegimeMap::standard(2.5),
        survey: Survey {
            confirmations: Vec::new(),
            examinations: Vec::new(),
            notes: Vec::new(),
        },
        curves: curves(),
        spheres: Spheres::default(),
        provenances: Vec::new(),
    }
}

fn figure(name: &str) -> Figure {
    let mut figures = figures(&reproduction(judgements())).into_iter();
    figures.find(|figure| figure.name == name).unwrap()
}

/// Circles of a size, which is printed with two digits.
fn circles(svg: &str, size: f64) -> usize {
    let size = (100.0 * size).round() / 100.0;
    svg.matches(&format!(" r=\"{size}\"")).count()
}

#[test]
fn every_point_is_marked() {
    let mark = Mark::of(Code::named("liggghts").unwrap());
    let (large, small) = (mark.size, mark.small().size);
    for name in ["yield-curves", "scaling"] {
        let svg = figure(name).svg();
        assert_eq!(circles(&svg, small), FRICTIONS.len(), "{name}: forces");
        assert_eq!(
            circles(&svg, large),
            1 + FRICTIONS.len(),
            "{name}: key, errors"
        );
    }
    let model_form = figure("model-form").svg();
    assert_eq!(circles(&model_form, large), 1 + FRICTIONS.len());
    // Key, two forces at two speeds, and two forces at the two time steps other than the paper's.
    assert_eq!(circles(&figure("convergence").svg(), large), 1 + 4 + 4);
    assert_eq!(circles(&figure("preparation").svg(), large), 1 + 2);
}

#[test]
fn the_axes_carry_symbols_and_units() {
    const LABELS: &str = "
        yield-curves: floor friction μ; F + 3 = (f + 3 m g)/(m g)
        scaling: stiffness kₙ r/(m g); F + 3 = (f + 3 m g)/(m g)
        force-series: time t/(10⁴ √(m/kₙ)); wall force F = f/(m g)
        convergence: wall speed v/(r √(kₙ/m)); time step Δt/√(m/kₙ)
        theory-error: floor friction μ; stiffness kₙ r/(m g)
        model-form: floor friction μ;  in %
        regimes: floor friction μ; stiffness ratio κ = kₙ/kₜ
        preparation: push A/(ε r); yield force F = f/(m g)";
    for line in LABELS.trim().lines() {
        let (name, labels) = line.trim().split_once(": ").unwrap();
        let svg = figure(name).svg();
        for label in labels.split("; ") {
            assert!(svg.contains(label), "{name}: {label}");
        }
    }
}

#[test]
fn curves_of_spheres_carry_a_mark_at_each_end() {
    let svg = spheres_figure(&Spheres::new()).svg();
    // Two to five bodies in two panels, and the key.
    assert_eq!(circles(&svg, style::OWN_WEIGHT.size), 2 * 4 + 1);
    for words in ["floor friction μ/μ", "(F + n + 1)/n", "n = 5, spheres"] {
        assert!(svg.contains(words), "{words}");
    }
    let empty = spheres_figure(&Spheres::default()).svg();
    assert_eq!(circles(&empty, style::OWN_WEIGHT.size), 1);
    assert!(!empty.contains("NaN") && !empty.contains("inf"));
}

#[test]
fn captions_tell_how_to_make_the_figure_again() {
    let mut all = figures(&reproduction(judgements()));
    all.push(spheres_figure(&Spheres::default()));
    for figure in all {
        assert!(figure.caption.contains("`tristack report --out DIR`"));
        assert!(
            figure
                .caption
                .contains(&format!("figures/{}.svg", figure.name))
        );
    }
}

#[test]
fn the_same_data_give_the_same_bytes() {
    let [one, other] = [(); 2].map(|()| figures(&reproduction(judgements())));
    assert_eq!(one, other);
    for figure in [&one[0], &one[2]] {
        let pdf = figure.pdf();
        assert!(pdf.starts_with(b"%PDF-"));
        assert_eq!(pdf, figure.pdf());
    }
}

#[test]
fn figures_without_any_run_are_still_drawn() {
    let figures = figures(&reproduction(Vec::new()));
    assert_eq!(figures.len(), 9);
    for figure in &figures {
        let svg = figure.svg();
        assert!(
            !svg.contains("NaN") && !svg.contains("inf"),
            "{}",
            figure.name
        );
        assert!(figure.pdf().starts_with(b"%PDF-"), "{}", figure.name);
    }
}
