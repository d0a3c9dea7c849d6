//! The command line: flags, lists, ranges, quantities with units, names.

use super::Seed;
use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;
use tristack::experiment::{density, length, mass, modulus};

/// One argument a line.
pub fn check(data: &[u8]) {
    let lines = data.split(|&byte| byte == b'\n');
    let arguments = lines.clone().map(|line| OsString::from_vec(line.to_vec()));
    let program = std::iter::once(OsString::from("tristack"));
    if let Err(refusal) = tristack::cli::check(program.chain(arguments)) {
        assert!(!refusal.to_string().is_empty());
    }
    for word in lines.filter_map(|line| std::str::from_utf8(line).ok()) {
        for read in [modulus, density, length, mass] {
            assert!(
                read(word).is_ok_and(is_usable) || read(word).is_err_and(|why| !why.is_empty())
            );
        }
    }
}

fn is_usable(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

pub fn seeds() -> Vec<Seed> {
    let lines = [
        "theory|--mu|0.3,critical|--stiffness|1e4,1e5|--pair-arm|-0.5|--format|json",
        "simulate|--code|native|--mu|0.2|--stiffness|1e2|--preparation|side-walls|--push|0.005|--dt|0.1",
        "simulate|--code|yade|--case|case.toml|--out|run|--time-limit|10",
        "sweep|--code|lammps|--mu|0.1:0.5:0.05|--stiffness|1e2,1e3|--kappa|2.5|--mu-d|0.7|--jobs|2",
        "crosscheck|--profile|paper|--codes|native,yade-wall|--shortcuts|--store|store",
        "crosscheck|--explain|yade/0.3/100",
        "predict|--youngs|1 MPa|--density|1000 kg/m3|--radius|1 cm|--length|40mm|--mu|0.3|--mu-uncertainty|0.05",
        "predict|--youngs|1 GPa|--mass|21.9 g|--radius|20 mm|--length|0.04m|--poisson|0.3|--mu|0.3|--contact|hertz",
        "regimes|--points|13|--kappa|2.5|--jobs|1",
        "bench|--codes|native|--repeats|3|--pyramids",
        "trajectories|--codes|lammps",
        "impacts|--codes|native|--law|hertz|--history|force|--out|impacts",
        "plan|--code|lammps|--mu|0.2,0.3|--stiffness|1e2|--out|away",
        "judge|away|--code-version|7.2|--out|verdict",
        "judge|--series|v4.csv|v2.csv|v1.csv|--speeds|4e-4,2e-4,1e-4|--mu|0.3|--stiffness|1e2|--coarse-step|c.csv",
        "report|--out|results",
    ];
    let seed = |(index, line): (usize, &str)| {
        (
            format!("line-{index}"),
            line.replace('|', "\n").into_bytes(),
        )
    };
    lines.into_iter().enumerate().map(seed).collect()
}
