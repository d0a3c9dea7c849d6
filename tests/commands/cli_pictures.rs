//! `simulate --svg` and `simulate --vtk`: the stack with its contact forces.

use crate::common::{Bench, standard_error};
use insta::assert_snapshot;
use std::fs;
use std::path::Path;
use tristack::dem::{compress_stack, compress_stack_into_frames};
use tristack::model::{Arrangement, Case, Stack};
use tristack::output::{representative_panels, run_svg, vtk_series};
use tristack::series::{Frame, Frames, Partner, Series};

const RUN: &str = "simulate --code native --mu 0.3 --stiffness 1e2";

fn run(bench: &Bench, more: &str) -> Case {
    let line = format!("{RUN} --out run {more}");
    bench.tristack(&line).assert().success();
    tristack::files::read_case(&bench.path("run/case.json")).expect("the case of the run")
}

/// Force on every body from all contacts.
fn resultants(frame: &Frame) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; frame.bodies.len()];
    for contact in &frame.contacts {
        let force = contact.force();
        for axis in 0..3 {
            sums[contact.body][axis] += force[axis];
            if let Partner::Body(other) = contact.partner {
                sums[other][axis] -= force[axis];
            }
        }
    }
    sums
}

#[test]
fn frames_come_from_the_same_run_and_their_forces_balance() {
    for more in ["", "--bodies 3", "--bodies 5 --mu-d 0.9"] {
        let case = run(&Bench::without_codes(), more);
        let (series, frames) = compress_stack_into_frames(&case, || true).expect("a finite series");
        assert_eq!(
            series,
            compress_stack(&case, || true).expect("a finite series")
        );
        let epsilon = case.stack.epsilon();
        for panel in &representative_panels(&frames)[..2] {
            for sum in resultants(panel.frame) {
                for (axis, weight) in [0.0, 1.0, 0.0].into_iter().enumerate() {
                    let error = sum[axis] / epsilon - weight;
                    assert!(error.abs() < 2e-2, "{more} {} {sum:?}", panel.title);
                }
            }
        }
        // Everything in the series is the same in both.
        let known = Frames::of_series(&series, &case).expect("all columns");
        assert_eq!(known.frames.len(), frames.frames.len());
        for (one, other) in known.frames.iter().zip(&frames.frames) {
            assert!((one.wall_height - other.wall_height).abs() < 1e-9);
            let places = |frame: &Frame| -> Vec<[[f64; 3]; 2]> {
                let bodies = frame.bodies.iter();
                bodies.map(|body| [body.position, body.rotation]).collect()
            };
            assert_eq!(places(one), places(other));
            for contact in one.contacts.iter() {
                let same = other.contacts.iter().find(|candidate| {
                    (candidate.body, candidate.partner) == (contact.body, contact.partner)
                });
                let same = same.expect("the contact is known to both");
                assert_eq!(same.force(), contact.force());
            }
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
    let frames = Frames::of_series(&series, &case).expect("all columns");
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
            sample.bodies[0].position[0],
            sample.bodies[0].position[1],
            0.0,
            sample.bodies[1].position[0],
            sample.bodies[1].position[1],
            0.0,
            sample.bodies[2].position[0],
            sample.bodies[2].position[1],
            0.0,
        ];
        assert_eq!(array(&cylinders, "Points"), centres);
        assert_eq!(
            array(&cylinders, "angle"),
            [
                sample.bodies[0].rotation[2],
                sample.bodies[1].rotation[2],
                sample.bodies[2].rotation[2]
            ]
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
        bodies: Vec::new(),
        contacts: Vec::new(),
    };
    let frames = Frames {
        frames: (0..1500).map(frame).collect(),
        pair_forces_known: true,
    };
    let files = vtk_series(&frames, &Stack::paper(0.3, 1e2));
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

/// A case of spheres with the protocol of cylinders.
fn case_of_spheres(bodies: u8, arrangement: Arrangement) -> Case {
    let mut case = run(&Bench::without_codes(), "");
    case.stack.bodies = bodies;
    case.stack.arrangement = arrangement;
    case
}

/// Made-up rows at rest, at yield and in collapse, as a code would report them: ring, top and turn outwards, and the forces of
/// floor and wall in m g.
fn spheres(case: &Case) -> Frames {
    let stack = &case.stack;
    let epsilon = stack.epsilon();
    let count = usize::from(stack.bodies) + 1;
    let mut text = "step,time,wall_force".to_owned();
    for number in 1..=count {
        for name in "x y z thetax thetay thetaz floorx floory floorz".split(' ') {
            text += &format!(",{name}{number}");
        }
    }
    let states = [
        (0_u32, 0.0, 0.004, 0.002, 1.4, 0.2),
        (1, 30.0, 0.13, 0.09, 9.0, 2.7),
        (2, 13.0, 0.60, 0.30, 4.5, 1.3),
    ];
    for (step, force, part, turn, normal, tangential) in states {
        let mut rows = vec![[0.0; 9]; count];
        let ring = stack.ring();
        for place in stack.places() {
            let [x, z] = place.outwards;
            let radius = ring.radius + part * (1.9 - ring.radius);
            // Rolling outwards is about [z, 0, −x].
            rows[place.body] = [
                radius * x,
                1.0 - normal * epsilon,
                radius * z,
                turn * z,
                0.0,
                -turn * x,
                -tangential * epsilon * x,
                normal * epsilon,
                -tangential * epsilon * z,
            ];
        }
        let radius = ring.radius + part * (1.9 - ring.radius);
        rows[stack.top()][1] = 1.0 + (4.0 - radius * radius).sqrt();
        text += &format!("\n{step},{},{}", f64::from(step), force * epsilon);
        for value in rows.iter().flatten() {
            text += &format!(",{value}");
        }
    }
    let (series, _) = Series::read_unplanned(text.as_bytes(), stack.bodies).expect("a series");
    Frames::of_series(&series, case).expect("all columns")
}

/// The places and words of the texts in a picture that are numbers of spheres.
fn numbers(picture: &str) -> Vec<(String, String)> {
    let texts = picture
        .lines()
        .filter(|line| line.contains("font-size=\"14\" text-anchor=\"middle\""));
    let parts = texts.map(|line| {
        let (place, words) = line.split_once('>').expect("a text");
        (
            place.to_owned(),
            words.trim_end_matches("</text>").to_owned(),
        )
    });
    parts
        .filter(|(_, words)| words.parse::<u8>().is_ok())
        .collect()
}

#[test]
fn forces_of_spheres_are_those_of_the_series() {
    let case = case_of_spheres(3, Arrangement::default());
    let epsilon = case.stack.epsilon();
    let frames = spheres(&case);
    let frame = &frames.frames[1];
    assert_eq!(frame.bodies.len(), 4);
    assert_eq!(frame.contacts.len(), 4);
    for contact in &frame.contacts {
        let place = case.stack.places().find(|place| place.body == contact.body);
        let expected = match place.map(|place| place.outwards) {
            Some([x, z]) => [-2.7 * x, 9.0, -2.7 * z],
            None => [0.0, -30.0, 0.0],
        };
        for (part, expected) in contact.force().into_iter().zip(expected) {
            assert!((part / epsilon - expected).abs() < 1e-13);
        }
    }
}

#[test]
fn nearer_spheres_are_drawn_over_farther_ones() {
    let case = case_of_spheres(3, Arrangement::default());
    let picture = run_svg("native", &case, &spheres(&case));
    // Sphere 4 is in front, 3 on the left, 2 on the right and farthest away.
    let words: Vec<String> = numbers(&picture)
        .into_iter()
        .map(|(_, words)| words)
        .collect();
    let expected = ["2", "3", "1", "4"];
    assert_eq!(words, expected.repeat(3));
    assert!(picture.contains("Parallel projection, seen from 20° above the floor"));
    assert!(!picture.contains("cylinder"));
    assert!(picture.contains("on sphere 4:"));
}

#[test]
fn spheres_with_other_numbers_are_the_same_picture() {
    for bodies in 3..=5 {
        let usual = case_of_spheres(bodies, Arrangement::default());
        let other = case_of_spheres(
            bodies,
            Arrangement {
                mirrored: true,
                renumbered: 2,
                ..Arrangement::default()
            },
        );
        let [one, two] = [usual, other].map(|case| run_svg("native", &case, &spheres(&case)));
        assert_ne!(one, two);
        let places = |picture: &str| -> Vec<String> {
            numbers(picture)
                .into_iter()
                .map(|(place, _)| place)
                .collect()
        };
        assert_eq!(places(&one), places(&two));
        let shapes = |picture: &str| -> Vec<String> {
            let lines = picture.lines().filter(|line| !line.starts_with("<text"));
            lines.map(str::to_owned).collect()
        };
        assert!(shapes(&one) == shapes(&two), "{bodies} spheres");
    }
}

#[test]
fn spheres_that_have_flown_apart_are_not_drawn() {
    let case = case_of_spheres(3, Arrangement::default());
    let mut frames = spheres(&case);
    let last = frames.frames.last_mut().expect("a frame");
    last.bodies[1].position[2] = f64::MAX;
    last.bodies[2].position[0] = -1e9;
    let picture = run_svg("native", &case, &frames);
    assert_eq!(numbers(&picture).len(), 4 + 4 + 2);
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    assert!(picture.len() < 300_000);
}

#[test]
fn vtk_series_of_spheres_is_in_space() {
    let case = case_of_spheres(4, Arrangement::default());
    let frames = spheres(&case);
    let files = vtk_series(&frames, &case.stack);
    assert_eq!(files.len(), 2 * 3 + 1);
    assert_eq!(files[2].name, "spheres_0001.vtp");
    let (bodies, contacts) = (&files[2].content, &files[3].content);
    let frame = &frames.frames[1];
    let points: Vec<f64> = frame.bodies.iter().flat_map(|body| body.position).collect();
    assert_eq!(array(bodies, "Points"), points);
    let rotations: Vec<f64> = frame.bodies.iter().flat_map(|body| body.rotation).collect();
    assert_eq!(array(bodies, "rotation"), rotations);
    assert_eq!(array(bodies, "radius"), [1.0; 5]);
    assert_eq!(array(bodies, "sphere"), [1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(array(contacts, "sphere"), [2.0, 3.0, 4.0, 5.0, 1.0]);
    assert_eq!(array(contacts, "partner"), [0.0, 0.0, 0.0, 0.0, -1.0]);
    let forces = array(contacts, "force");
    assert_eq!(forces.len(), 15);
    assert!(forces[5].abs() > 2.6 && forces[3].abs() < 1e-12);
    for (contact, force) in frame.contacts.iter().zip(forces.chunks(3)) {
        let own = contact.force();
        assert!((0..3).all(|axis| force[axis] == own[axis] / case.stack.epsilon()));
    }
    let collection = &files[6].content;
    assert!(collection.contains("those between spheres are not reported"));
}

#[test]
fn a_picture_is_a_pdf_where_its_name_says_so_and_no_other_format() {
    let bench = Bench::without_codes();
    run(&bench, "--svg stack.pdf");
    let picture = fs::read(bench.path("stack.pdf")).expect("a picture");
    assert!(picture.starts_with(b"%PDF-"));
    let line = "simulate --code native --mu 0.3 --stiffness 100 --svg stack.png";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(1);
    for part in ["--svg", "stack.png", ".svg or .pdf"] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
    assert!(!bench.path("stack.png").exists());
}
