//! The register of claims.

use super::{Seed, reference};
use tristack::paper::claims::{PaperTheory, Register};

pub fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    match Register::from_toml(text, "claims.toml") {
        Ok(register) => is_sound(&register),
        Err(refusal) => assert!(refusal.to_string().starts_with("claims.toml: ")),
    }
}

fn is_sound(register: &Register) {
    let paper = PaperTheory::printed();
    let mut names: Vec<&str> = register
        .claims
        .iter()
        .map(|claim| claim.id.as_str())
        .collect();
    names.sort_unstable();
    assert!(
        names.is_sorted_by(|one, other| one < other),
        "a name stands twice"
    );
    for claim in &register.claims {
        assert!(
            claim
                .allowed
                .as_ref()
                .is_none_or(|allowed| allowed.size > 0.0 && allowed.size.is_finite())
        );
        assert!(claim.check.is_some() != claim.untestable.is_some());
        if let Some(erratum) = &claim.erratum {
            let corrected = erratum.apply(&paper).expect("known constants");
            assert!(erratum.words(&corrected).is_some());
            assert!(erratum.set.values().all(|value| value.is_finite()));
        }
    }
}

/// The first claims, one with an erratum, and the shortest that are accepted.
pub fn seeds() -> Vec<Seed> {
    let text = std::fs::read_to_string(reference().join("claims.toml")).expect("the register");
    let claims: Vec<&str> = text.split("[[claim]]").skip(1).collect();
    let erratum = claims.iter().position(|claim| claim.contains("erratum"));
    let chosen = [0, 1, claims.len() / 2, erratum.unwrap_or(0)];
    let seeds = chosen.into_iter().map(|index| {
        let claim = format!("[[claim]]{}", claims[index]);
        (format!("claim-{index}"), claim.into_bytes())
    });
    let short = "[[claim]]\nid = 'a'\nplace = 'p'\nstatement = 's'\nkind = 'number'\n";
    let check =
        format!("{short}check = 'quintic'\nallowed = {{ size = 0.1, of = 'F', because = 'x' }}\n");
    let untestable = format!("{short}untestable = 'u'\n");
    seeds
        .chain([check, untestable].map(|text| (format!("short-{}", text.len()), text.into_bytes())))
        .collect()
}
