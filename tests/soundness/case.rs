//! Case files, JSON and TOML, and everything that is made of a case before it is run.

use super::{Seed, marked, scenes};
use std::path::Path;
use tristack::code::{Code, SettledCode, Task};
use tristack::model::{Case, PartialCase, Preparation, SideWalls, Stack};
use tristack::study::yield_force::plan;

const FILES: [&str; 2] = ["case.json", "case.toml"];

/// The most that a case may ask for, whatever it says.
const MOST_ROWS: u64 = 1_000_000;
const MOST_STEPS: u64 = 200_000_000_000;

pub fn check(data: &[u8]) {
    let Some((&kind, text)) = data.split_first() else {
        return;
    };
    let path = Path::new(FILES[usize::from(kind) % FILES.len()]);
    for parsed in [
        Case::parse(text, path),
        Case::parse_with(text, path, |written| Ok(completed(written))),
    ] {
        match parsed {
            Ok(case) => is_sound(&case),
            Err(refusal) => assert!(refusal.to_string().contains("case.")),
        }
    }
}

/// What is left out, as it is in a short case.
fn completed(written: &PartialCase) -> Case {
    let convention = written.convention.unwrap_or_default();
    let stack = written.stack.in_law(convention.law.power);
    let mut planned = scenes::short_case().protocol;
    if let Some(walls) = written.protocol.side_walls(stack.epsilon()) {
        planned.preparation = Preparation::SideWalls(walls);
    }
    Case {
        stack,
        convention,
        protocol: written.protocol.over(&planned),
    }
}

fn is_sound(case: &Case) {
    case.validate().expect("what is accepted is valid");
    let again = Case::parse(case.to_json().as_bytes(), Path::new("case.json"));
    assert_eq!(again.expect("its own JSON is a case"), *case);
    assert_eq!(case.content_hash().len(), 64);
    assert!(case.total_steps() <= MOST_STEPS);
    let schedule = case.protocol.schedule();
    assert!(schedule.rows() <= MOST_ROWS);
    let steps: Vec<u64> = schedule.sampled_steps().take(100).collect();
    assert!(steps.is_sorted_by(|earlier, later| earlier < later));
    assert_eq!(steps.len() as u64, schedule.rows().min(100));
    for (name, value) in case.parameters().as_object().expect("named numbers") {
        assert!(value.is_number(), "{name} = {value}");
    }
}

pub fn seeds() -> Vec<Seed> {
    let mut walls = scenes::short_case();
    walls.protocol.preparation = Preparation::SideWalls(SideWalls::paper(0.005, 0.01));
    let toml = "[stack]\nfloor_friction = 0.3\nstiffness = 100.0\n[convention]\npair_arm = -0.5\n\
        coulomb_operand = \"spring\"\n[protocol]\ntime_step = 0.1\nwall_speed = 1e-3\nwall_travel = 0.8\n\
        preparation = { kind = \"gravity-ramp\", ramp_time = 100.0, rest_time = 100.0 }\n\
        sampling = { coarse_interval = 10.0, fine_from_travel = 0.6, fine_interval = 2.0 }\n";
    let partial_walls = "[stack]\nmu = 0.3\nkappa = 1.5\n[protocol.preparation]\nkind = \"side-walls\"\npush = 0.01\n";
    let stack = Stack::paper(0.3, 1e3);
    let planned = plan(&yade(), &stack, yade().convention()).cases;
    let planned = planned
        .into_iter()
        .enumerate()
        .map(|(index, case)| (format!("planned-{index}"), marked(0, case.to_json())));
    let own = [
        ("short", marked(0, scenes::short_case().to_json())),
        (
            "shortcuts",
            marked(0, scenes::case_with_shortcuts().to_json()),
        ),
        ("side-walls", marked(0, walls.to_json())),
        ("toml", marked(1, toml)),
        ("partial", marked(1, "[stack]\nmu = 0.3\n")),
        ("partial-walls", marked(1, partial_walls)),
    ];
    own.map(|(name, input)| (name.to_owned(), input))
        .into_iter()
        .chain(planned)
        .collect()
}

fn yade() -> SettledCode {
    let code = Code::named("yade").expect("it is built in");
    code.as_declared().expect("nothing is left out")
}
