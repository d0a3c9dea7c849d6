//! `simulate --svg` and `simulate --vtk`: the stack with its contact forces.

mod common;

use common::Bench;
use insta::assert_snapshot;
use std::fs;
use std::path::Path;
use tristack::dem::{compress_stack, compress_stack_into_frames};
use tristack::model::Case;
use tristack::output::{representative_panels, run_svg, vtk_series};
use tristack::series::{Frame, Frames, Partner};

const RUN: &str = "simulate --code native --mu 0.3 --stiffness 1e2";

fn run(bench: &Bench, more: &str) -> Case {
    let line = format!("{RUN} --out run {more}");
    bench.tristack(&line).assert().success();
    Case::read(&bench.path("run/case.json")).expect("the case of the run")
}

/// Force on every cylinder from all contacts.
fn resultants(frame: &Frame) -> [[f64; 2]; 3] {
    let mut sums = [[0.0; 2]; 3];
    for contact in &frame.contacts {
        let force = contact.force();
        for axis in 0..2 {
            sums[contact.cylinder][axis] += force[axis];
            if let Partner::Cylinder(other) = contact.partner {
                sums[other][axis] -= force[axis];
            }
        }
    }
    sums
}

#[test]
fn frames_come_from_the_same_run_and_their_forces_balance() {
    let case = run(&Bench::without_codes(), "");
    let (series, frames) = compress_stack_into_frames(&case, || true).expect("a finite series");
    assert_eq!(
        series,
        compress_stack(&case, || true).expect("a finite series")
    );
    let epsilon = case.stack.epsilon();
    for panel in &representative_panels(&frames)[..2] {
        for sum in resultants(panel.frame) {
            assert!(sum[0].abs() < 2e-2 * epsilon, "{} {sum:?}", panel.title);
            assert!(
                (sum[1] / epsilon - 1.0).abs() < 2e-2,
                "{} {sum:?}",
                panel.title
            );
        }
    }
    // Everything in the series is the same in both.
    let known = Frames::of_series(&series, case.protocol.wall_speed).expect("all columns");
    assert_eq!(known.frames.len(), frames.frames.len());
    for (one, other) in known.frames.iter().zip(&frames.frames) {
        assert!((one.wall_height - other.wall_height).abs() < 1e-9);
        for contact in one.contacts.iter() {
            let same = other.contacts.iter().find(|candidate| {
                (candidate.cylinder, candidate.partner) == (contact.cylinder, contact.partner)
            });
            let same = same.expect("the contact is known to both");
            assert_eq!(same.force(), contact.force());
        }
    }
}

#[test]
fn svg_shows_rest_yield_and_collapse_with_their_forces() {
    let bench = Bench::without_codes();
    let case = run(&bench, "--svg stack.svg");
    let picture = fs::read_to_string(bench.path("stack.svg")).expect("a picture");
    let (_, frames) = compress_stack_into_frames(&case, || true).expect("a finite series");
    assert_eq!(picture, run_svg("native", &case, &frames));
    let titles: Vec<String> = representative_panels(&frames)
        .iter()
        .map(|panel| format!("{}: {:.4}", panel.title, panel.frame.wall_force))
        .collect();
    assert_snapshot!(titles.join("\n"));
    let words: Vec<&str> = picture
        .lines()
        .filter(|line| line.starts_with("<text"))
        .collect();
    assert_snapshot!(words.join("\n"));
}

#[test]
fn svg_of_an_external_code_leaves_out_what_it_does_not_report() {
    let case = run(&Bench::without_codes(), "");
    let series = compress_stack(&case, || true).expect("a finite series");
    let frames = Frames::of_series(&series, case.protocol.wall_speed).expect("all columns");
    let picture = run_svg("liggghts", &case, &frames);
    assert!(picture.contains("liggghts reports the forces of floor and wall alone"));
    assert!(!picture.contains(">a</tspan>"));
}

/// The values of a data array in a VTK file.
fn array(text: &str, name: &str) -> Vec<f64> {
    let start = text
        .find(&format!("Name=\"{name}\""))
        .expect("the array is there");
    let text = &text[start..];
    let from = text.find('>').expect("its tag ends") + 1;
    let to = text.find("</DataArray>").expect("it ends");
    let values = text[from..to].split_whitespace();
    values
        .map(|value| value.parse().expect("a number"))
        .collect()
}

fn times(directory: &Path) -> Vec<(f64, String)> {
    let text = fs::read_to_string(directory.join("stack.pvd")).expect("a collection");
    let attribute = |line: &str, name: &str| -> Option<String> {
        let rest = line.split_once(&format!("{name}=\""))?.1;
        Some(rest.split_once('"')?.0.to_owned())
    };
    let sets = text.lines().filter(|line| line.starts_with("<DataSet"));
    sets.map(|line| {
        let time = attribute(line, "timestep").expect("a time");
        let file = attribute(line, "file").expect("a file");
        (time.parse().expect("a number"), file)
    })
    .collect()
}

#[test]
fn vtk_series_says_what_the_series_says() {
    let bench = Bench::without_codes();
    run(&bench, "--vtk para");
    fs::write(bench.path("para/cylinders_9999.vtp"), "of an earlier run").expect("a file");
    fs::write(bench.path("para/cylinders_mine.vtp"), "of the user").expect("a file");
    let case = run(&bench, "--vtk para");
    let series = compress_stack(&case, || true).expect("a finite series");
    let sets = times(&bench.path("para"));
    assert_eq!(sets.len(), 2 * series.samples().len());
    assert!(!bench.path("para/cylinders_9999.vtp").exists());
    assert!(bench.path("para/cylinders_mine.vtp").exists());
    for (sample, pair) in series.samples().iter().zip(sets.chunks(2)) {
        let [cylinders, contacts] = [&pair[0], &pair[1]].map(|(time, file)| {
            assert_eq!(*time, sample.time);
            fs::read_to_string(bench.path("para").join(file)).expect("a row")
        });
        let centres = [
            sample.x1, sample.y1, 0.0, sample.x2, sample.y2, 0.0, sample.x3, sample.y3, 0.0,
        ];
        assert_eq!(array(&cylinders, "Points"), centres);
        assert_eq!(
            array(&cylinders, "angle"),
            [sample.theta1, sample.theta2, sample.theta3]
        );
        let partners = array(&contacts, "partner");
        let weights = array(&contacts, "normal_force");
        let on_top = partners.iter().position(|&partner| partner == -1.0);
        let force = on_top.map_or(0.0, |index| weights[index]);
        assert_eq!(force, sample.wall_force / case.stack.epsilon());
        assert_eq!(array(&contacts, "force").len(), 3 * partners.len());
    }
}

#[test]
fn long_vtk_series_are_thinned_but_keep_the_largest_force_and_the_end() {
    let frame = |index: u16| Frame {
        step: u64::from(index),
        time: f64::from(index),
        wall_force: if index == 778 { 2.0 } else { 1.0 },
        wall_height: 3.0,
        cylinders: Vec::new(),
        contacts: Vec::new(),
    };
    let frames = Frames {
        frames: (0..1500).map(frame).collect(),
        pair_forces_known: true,
    };
    let files = vtk_series(&frames, 0.01);
    let collection = &files.last().expect("a collection").content;
    assert_eq!(files.len(), 2 * 502 + 1);
    for time in ["0", "778", "1497", "1499"] {
        assert!(
            collection.contains(&format!("timestep=\"{time}\"")),
            "{time}"
        );
    }
    assert!(collection.contains("502 of 1500 rows"));
}
