//! The preparation between side walls (supplement, I.B), by native runs.

use super::Check;
use crate::claims::finding::{Finding, worst};
use crate::claims::notation::{list, number, percent};
use crate::code::Code;
use crate::study::preparation::PreparationStudy;

pub(crate) const CHECKS: &[Check] = &[
    Check::runs("prepared-without-contact", |_, runs| {
        let mut without = 0;
        let mut listed = Vec::new();
        for study in &runs.preparation {
            without += usize::from(contact_forces(study).contains(&(0.0, Some(0.0))));
            if let Some(found) = study.critical_push {
                let push = found.push * study.stack.stiffness;
                listed.push(format!("{push:.4} at {}", name(study)));
            }
        }
        let all = runs.preparation.len();
        if all == 0 {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol: $c = 0$ after it with $A = 0$ for {without} of {all} stacks, and up to $A/(\\epsilon r)$ \
             of {}",
            list(listed)
        );
        Ok(Finding::exceptions(all - without, evidence))
    }),
    // Counts the stacks in which every A leaves the same c.
    Check::runs("push-controls-contact", |_, runs| {
        let mut alike = 0;
        let mut listed = Vec::new();
        for study in &runs.preparation {
            let pushed = contact_forces(study).into_iter();
            let pushed = pushed.map(|(push, force)| (push, force.unwrap_or(f64::NAN)));
            let pushed: Vec<(f64, f64)> = pushed.collect();
            let contacts = pushed.iter().map(|&(_, force)| force);
            let highest = contacts.clone().fold(f64::NEG_INFINITY, f64::max);
            let spread = highest - contacts.fold(f64::INFINITY, f64::min);
            // In m g; c is exactly 0 in runs that end without contact.
            alike += usize::from(spread.is_nan() || spread <= 1e-3);
            listed.push(format!("{} at {}", course(study, &pushed), name(study)));
        }
        if runs.preparation.is_empty() {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol, $c/mg$ over $A$: {}. A larger $A$ need not leave a larger $c$",
            list(listed)
        );
        Ok(Finding::exceptions(alike, evidence))
    }),
    // Compares the yield force after A = 0 with that after the largest A that also ends with c = 0.
    Check::runs("no-contact-specifies", |_, runs| {
        let mut shifts = Vec::new();
        let mut listed = Vec::new();
        for study in &runs.preparation {
            let critical = study.critical_push;
            if let Some(shift) = critical.and_then(|found| study.shift(found.push)) {
                listed.push(format!("{} at {}", percent(shift, 3), name(study)));
                shifts.push(shift.abs());
            }
        }
        if shifts.is_empty() {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol: between $A = 0$ and the largest $A$ that also ends with $c = 0$, $f + 3mg$ at yield \
             changes by {}. The tangential forces that $A$ leaves are not fixed by $c = 0$",
            list(listed)
        );
        Ok(Finding::new(worst(shifts), 1e-4, evidence))
    }),
];

const MISSING: &str = "there is no native study of the preparation in this reproduction";

/// Returns each push with the contact force that it leaves, sorted by push: native runs under the paper's convention.
fn contact_forces(study: &PreparationStudy) -> Vec<(f64, Option<f64>)> {
    let native = Code::native();
    let rows = study.rows_of(&native, &native);
    let pushed = rows.filter_map(|row| Some((row.push?, row.contact_force)));
    let mut pushed: Vec<_> = pushed.collect();
    pushed.sort_by(|left, right| left.0.total_cmp(&right.0));
    pushed
}

/// Describes the largest c and, if c falls again, c at the largest push.
fn course(study: &PreparationStudy, pushed: &[(f64, f64)]) -> String {
    let largest = pushed
        .iter()
        .max_by(|left, right| left.1.total_cmp(&right.1));
    let at = |&(push, force): &(f64, f64)| {
        let push = number(push * study.stack.stiffness);
        let force = (1e3 * force).round() / 1e3;
        format!("{force} at $A = {push}\\epsilon r$")
    };
    match (largest, pushed.last()) {
        (Some(largest), Some(last)) if largest != last => {
            format!("a maximum of {} and {}", at(largest), at(last))
        }
        (Some(largest), _) => format!("0 up to some $A$ and then growing, to {}", at(largest)),
        _ => "nothing".to_owned(),
    }
}

fn name(study: &PreparationStudy) -> String {
    let friction = number(study.stack.floor_friction);
    let stiffness = number(study.stack.stiffness);
    format!("$(\\mu, k_n r/mg) = ({friction}, {stiffness})$")
}
