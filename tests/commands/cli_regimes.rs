//! `tristack regimes`, as a user sees it.

use crate::common::{Bench, assert_only, standard_error};
use insta::assert_snapshot;
use std::fs;

#[test]
fn regimes_are_printed_and_written_and_all_agree() {
    let bench = Bench::without_codes();
    let output = bench
        .tristack("regimes --points 2 --out regimes")
        .output()
        .expect("the program starts");
    assert_eq!(output.status.code(), Some(0));
    let table = String::from_utf8(output.stdout).expect("its output is text");
    assert_snapshot!(table);
    let said = String::from_utf8(output.stderr).expect("its output is text");
    assert!(said.contains("0 differ, 0 inconclusive"), "{said}");
    let directory = bench.path("regimes");
    let names = [
        "boundaries.csv",
        "largest_forces.csv",
        "regimes.csv",
        "regimes.md",
        "regimes.svg",
    ];
    assert_only(&directory, &names);
    let read = |name: &str| fs::read_to_string(directory.join(name)).expect("a file");
    let header = read("regimes.csv").lines().next().map(str::to_owned);
    assert_eq!(
        header.as_deref(),
        Some(
            "map,stiffness,mu,mu_d,kappa,bodies,event,stage,force,T,largest_force,failure_mode,then"
        )
    );
    assert_eq!(read("regimes.csv").lines().count(), 1 + 3 * 25 * 40);
    assert!(read("regimes.md").contains("`tristack regimes --points 2`"));
    let figure = read("regimes.svg");
    assert!(figure.starts_with("<svg") && figure.contains("falls under own weight"));
}

#[test]
fn wrong_values_are_refused_by_the_name_of_their_flag() {
    let bench = Bench::without_codes();
    for (line, flag, accepted) in [
        ("regimes --kappa -1", "`--kappa` is -1", "must be"),
        ("regimes --kappa nan", "'nan' for '--kappa <K>'", "finite"),
        ("regimes --kappa 1.0774", "`--kappa` is 1.0774", "must be"),
        ("regimes --points 1", "'1' for '--points <N>'", "from 2 to"),
    ] {
        let mut command = bench.tristack(line);
        assert_eq!(command.output().expect("it starts").status.code(), Some(1));
        let said = standard_error(&mut command);
        assert!(said.contains(flag) && said.contains(accepted), "{said}");
    }
}
