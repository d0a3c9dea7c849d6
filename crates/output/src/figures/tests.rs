//! Tests with made-up runs, in which every mark can be counted.

use super::style::{Mark, PUBLISHED_CURVE};
use super::*;
use crate::code::{Code, Interrupt};
use crate::files::write_atomically;
use crate::model::{HistoryUpdate, Power, Stack};
use crate::paper::published::{
    Checkout, Published, RepeatedForce, RepeatedSeries, published_forces, published_series,
};
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
    let settled = code.as_declared().unwrap();
    let mut study = plan(&settled, &Stack::paper(mu, 100.0), settled.convention());
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

/// Returns a study of LIGGGHTS at two pushes, one of which has failed.
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

/// Returns the rows of every code at every friction; those of LAMMPS have failed.
fn judgements() -> Vec<Judgement> {
    let codes = Code::with_power(Power::Linear).into_iter();
    let rows = codes.flat_map(|code| {
        let force = (code != Code::named("lammps").unwrap()).then_some(4.0);
        FRICTIONS.map(|mu| judgement(code.clone(), mu, force))
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
        codes_by_limit: ["liggghts", "lammps"]
            .map(|name| vec![Code::named(name).unwrap().as_declared().unwrap()])
            .into(),
    }
}

fn exponent() -> Exponent {
    Exponent {
        code: Code::native(),
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
        maps: RegimeMap::standard(2.5, HistoryUpdate::Fixed),
        survey: Survey {
            confirmations: Vec::new(),
            examinations: Vec::new(),
            notes: Vec::new(),
        },
        curves: curves(),
        spheres: Spheres::default(),
        published: None,
        provenances: Vec::new(),
    }
}

fn figure(name: &str) -> Figure {
    let mut figures = figures(&reproduction(judgements())).into_iter();
    figures.find(|figure| figure.name == name).unwrap()
}

/// Counts the circles of a size, which is printed with two digits.
fn circles(svg: &str, size: f64) -> usize {
    let size = (100.0 * size).round() / 100.0;
    svg.matches(&format!(" r=\"{size}\"")).count()
}

/// Returns the words of every text, without their styles.
fn texts(svg: &str) -> Vec<String> {
    let lines = svg.lines().filter(|line| line.starts_with("<text"));
    let words = lines.map(|line| {
        let parts = line
            .split('<')
            .filter_map(|part| Some(part.split_once('>')?.1));
        parts.collect::<String>()
    });
    words.collect()
}

#[test]
fn every_point_is_marked() {
    let mark = Mark::of(&Code::named("liggghts").unwrap());
    let (large, small) = (mark.size, mark.small().size);
    // Errors are shown at the stiffnesses and at the frictions of the paper: 100, and of these frictions 0.3.
    for (name, errors) in [("yield-curves", FRICTIONS.len()), ("scaling", 1)] {
        let svg = figure(name).svg();
        assert_eq!(circles(&svg, small), FRICTIONS.len(), "{name}: forces");
        assert_eq!(circles(&svg, large), 1 + errors, "{name}: key, errors");
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
        scaling: stiffness kn r/(m g); F + 3 = (f + 3 m g)/(m g)
        force-series: time t/(104 √(m/kn)); wall force F = f/(m g)
        convergence: wall speed v/(r √(kn/m)); time step Δt/√(m/kn)
        theory-error: floor friction μ; stiffness kn r/(m g)
        model-form: floor friction μ;  in %
        regimes: floor friction μ; stiffness ratio κ = kn/kt
        preparation: push A/(ε r); yield force F = f/(m g)";
    for line in LABELS.trim().lines() {
        let (name, labels) = line.trim().split_once(": ").unwrap();
        let texts = texts(&figure(name).svg());
        for label in labels.split("; ") {
            let found = texts.iter().any(|words| words.contains(label));
            assert!(found, "{name}: {label}: {texts:?}");
        }
    }
}

#[test]
fn small_letters_are_of_one_size_in_every_figure_and_layout() {
    for figure in figures(&reproduction(judgements())) {
        for svg in [figure.svg(), figure.narrow_svg()] {
            let tags = svg.split("<tspan").skip(1);
            let tags = tags.filter_map(|part| Some(part.split_once('>')?.0));
            let sizes =
                tags.filter_map(|tag| Some(tag.split_once("font-size=\"")?.1.split_once('"')?.0));
            assert!(sizes.clone().all(|size| size == "75%"), "{}", figure.name);
            let unicode = |letter: char| "ₙₜ₁₂⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(letter);
            assert!(!svg.contains(unicode), "{}", figure.name);
        }
    }
}

#[test]
fn a_point_on_which_nothing_is_decided_wears_a_ring_that_the_key_names() {
    let ring = style::INCONCLUSIVE.size;
    for name in ["yield-curves", "scaling"] {
        let sure = figure(name).svg();
        assert_eq!(circles(&sure, ring), 0, "{name}");
        assert!(!texts(&sure).contains(&"inconclusive".to_owned()));
    }
    let mut rows = judgements();
    let open = rows.iter_mut().find(|row| row.mu() == 0.3).unwrap();
    open.grounds.compare(1e-8, 1e-3, 1e-5, None);
    assert_eq!(open.verdict(), Verdict::Inconclusive);
    let all = figures(&reproduction(rows));
    for name in ["yield-curves", "scaling"] {
        let figure = all.iter().find(|figure| figure.name == name).unwrap();
        let svg = figure.svg();
        // The force, the error, and the key.
        assert_eq!(circles(&svg, ring), 3, "{name}");
        assert!(texts(&svg).contains(&"inconclusive".to_owned()), "{name}");
    }
}

#[test]
fn narrow_layouts_have_every_text_of_the_wide_ones_and_fit_a_small_screen() {
    for figure in figures(&reproduction(judgements())) {
        let (wide, narrow) = (figure.svg(), figure.narrow_svg());
        let [mut one, mut other] = [&wide, &narrow].map(|svg| texts(svg).concat().into_bytes());
        one.sort_unstable();
        other.sort_unstable();
        assert_eq!(one, other, "{}", figure.name);
        let width = narrow
            .split("width=\"")
            .nth(1)
            .and_then(|rest| rest.split('"').next());
        let width: f64 = width.unwrap().parse().unwrap();
        assert!(width < 400.0, "{}: {width}", figure.name);
    }
}

#[test]
fn every_code_has_its_own_limit_in_the_figure_on_preparation() {
    let mut study = preparation();
    let ramp = |code: &str, limit| PreparationRow {
        code: Code::named(code).unwrap(),
        convention_of: Code::named(code).unwrap(),
        push: None,
        limit_force: Some(limit),
        ..study.rows[0].clone()
    };
    let rows = [
        ramp("native", 4.318),
        ramp("liggghts", 4.27),
        ramp("yade", 4.27),
        ramp("yade-wall", 4.103),
    ];
    study.rows.extend(rows);
    let svg = preparation::preparation(&study).svg();
    let texts = texts(&svg);
    for words in ["native", "LIGGGHTS; YADE, box", "YADE, wall"] {
        assert!(texts.iter().any(|own| own == words), "{words}: {texts:?}");
    }
    // Three levels, and the sample in the key.
    assert_eq!(svg.matches("stroke-dasharray=\"9 3\"").count(), 3 + 1);
}

#[test]
fn the_maps_of_regimes_name_their_narrow_strip_and_carry_a_key() {
    let svg = figure("regimes").svg();
    let upwards = svg.lines().filter(|line| line.contains("rotate(-90"));
    let named = upwards.filter(|line| line.contains("falls under own weight"));
    assert_eq!(named.count(), 1);
    let texts = texts(&svg);
    for words in [
        "beyond it another event comes first",
        "the same event first, another end",
        "native runs on both sides agree",
        "(a) at μd = 0.7, κ = 2.5",
    ] {
        assert!(texts.iter().any(|own| own == words), "{words}: {texts:?}");
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
fn captions_have_their_formulas_in_tex() {
    let mut all = figures(&reproduction(judgements()));
    all.push(spheres_figure(&Spheres::default()));
    for figure in all {
        let plain = figure.caption.split('$').step_by(2).collect::<String>();
        for relic in ["μ", "κ", "kₙ", "√", "F_", "10⁻"] {
            assert!(!plain.contains(relic), "{relic} in {}", figure.caption);
        }
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

/// Returns some points of the published figures, read from a checkout; none of them is run.
fn published() -> Published {
    let place = tempfile::tempdir().unwrap();
    for (file, rows) in [
        ("fig2a/data/k1e+2.txt", "0.3 30.2"),
        ("fig2b/data/mu0.33.txt", "1000 367.5\n10000 3610.9"),
        ("figS3b/data/vwall.txt", "0.001 5.28\n0.0000001 4.8804"),
        (
            "figS2/data/f_vwall1.0e-06.txt",
            "10000 0\n100000 4\n120000 4.3\n130000 3",
        ),
    ] {
        let file = place.path().join(file);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        write_atomically(&file, rows.as_bytes()).unwrap();
    }
    let checkout = Checkout::read(place.path()).unwrap();
    let forces = published_forces(&checkout).into_iter();
    let series = published_series(&checkout).into_iter();
    Published {
        files: checkout.files.clone(),
        forces: forces
            .map(|published| RepeatedForce {
                published,
                found: None,
            })
            .collect(),
        series: series
            .map(|published| RepeatedSeries {
                published,
                found: None,
            })
            .collect(),
        contradictions: Vec::new(),
    }
}

#[test]
fn every_published_point_is_in_view() {
    let mut shown = reproduction(judgements());
    let alone = figures(&shown);
    shown.published = Some(published());
    let with_published = figures(&shown);
    let svg = |name: &str| {
        [&alone, &with_published].map(|all| all.iter().find(|own| own.name == name).unwrap().svg())
    };
    // With its entry in the key.
    for (name, squares) in [("yield-curves", 2), ("scaling", 3), ("convergence", 3)] {
        let [before, after] = svg(name).map(|svg| svg.matches("<polygon").count());
        assert_eq!(after - before, squares, "{name}");
    }
    let [_, scaling] = svg("scaling");
    assert!(texts(&scaling).contains(&"μ = 0.33".to_owned()));
    let [before, after] = svg("force-series");
    let lines = |svg: &str| svg.matches(PUBLISHED_CURVE.colour).count();
    assert_eq!(lines(&after) - lines(&before), 2, "series and key");
}
