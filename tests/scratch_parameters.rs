//! Scratch.
use tristack::code::{Code, ParameterFormat, Task};
use tristack::model::*;
use tristack::study::yield_force::Profile;

#[test]
fn print() {
    let mut text = String::new();
    let mut tell = |code: Code, line: String| {
        text += &format!("{code} {line}\n");
    };
    for code in Code::all() {
        for m in Profile::Quick.measurements(&[code]) {
            for case in m.cases {
                tell(code, ParameterFormat::Json.content(&case.parameters()));
                tell(code, code.deck_hash(&case));
            }
        }
        for rows in [2, 5, 20] {
            let p = Pyramid::touching(rows, 100.0, code.convention());
            for f in [
                ParameterFormat::Json,
                ParameterFormat::Toml,
                ParameterFormat::LammpsVariables,
            ] {
                tell(code, f.content(&p.parameters()));
            }
            tell(code, format!("{:?}", p.files()));
            tell(code, code.deck_hash(&p));
        }
        let stopped = tristack::study::convention::probe(&code.declaration(), |tests| {
            for test in tests {
                tell(code, ParameterFormat::Toml.content(&test.parameters()));
                tell(code, code.deck_hash(test));
            }
            tests
                .iter()
                .map(|t| tristack::dem::run_contact_test(t).map_err(drop))
                .collect()
        });
        let _ = stopped;
        let mut case = Profile::Quick.measurements(&[code]).remove(0).cases[0];
        case.protocol.preparation = Preparation::SideWalls(SideWalls {
            push: 1e-5,
            fall_speed: 1e-3,
            landing_speed: 1e-4,
            settle_time: 100.0,
            withdrawal: 1e-3,
            withdrawal_speed: 1e-5,
            rest_time: 50.0,
        });
        tell(code, ParameterFormat::Json.content(&case.parameters()));
        tell(code, code.deck_hash(&case));
    }
    std::fs::write(std::env::var("SCRATCH").unwrap(), text).unwrap();
}

#[test]
fn recorded() {
    for code in Code::all().into_iter().skip(1) {
        let recording = tristack::runs::Recorded::embedded()
            .recording(code)
            .unwrap();
        let (table, archive) = recording.to_files(code);
        assert_eq!(
            table,
            std::fs::read_to_string(format!("reference/recorded/{code}.csv")).unwrap()
        );
        assert!(archive == std::fs::read(format!("reference/recorded/{code}.tar.gz")).unwrap());
    }
}
