//! `tristack crosscheck --explain ROW`.

use super::code_names::{code_named, unknown};
use super::convention::{settle, settle_after_probes};
use super::options::{
    Format, Friction, ResolutionOptions, RunOptions, Stiffness, as_flag, find_all, single,
};
use super::progress::Reporter;
use super::stack_set::{StackSet, with_options};
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::model::{Power, Stack};
use crate::output::{explained, explanation, wrapped_to_screen};
use crate::study::Campaign;
use crate::study::yield_force::measure_with_twin;

/// One row of a crosscheck.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RowName {
    code: Code,
    mu: Friction,
    stiffness: f64,
}

/// Reads CODE/MU/STIFFNESS.
pub(super) fn row_name(text: &str) -> Result<RowName, String> {
    // The path of a folder may contain further slashes.
    let parts: Vec<&str> = text.rsplitn(3, '/').collect();
    let [stiffness, mu, code] = parts[..] else {
        return Err("accepted is CODE/MU/STIFFNESS, as in yade/0.3/100".to_owned());
    };
    let code = code_named(code)
        .ok_or_else(|| unknown(code))?
        .map_err(|error| error.to_string())?;
    let mu: Friction = single(mu).map_err(|trouble| format!("MU is `{mu}`: {trouble}"))?;
    let Stiffness(stiffness) =
        single(stiffness).map_err(|trouble| format!("STIFFNESS is `{stiffness}`: {trouble}"))?;
    let stack = Stack::paper(mu.of_cylinders(), stiffness);
    stack
        .validate()
        .map_err(|error| as_flag(error).to_string())?;
    Ok(RowName {
        code,
        mu,
        stiffness,
    })
}

/// Measures one row by the profile of `stacks` and with their other parameters, and prints every step from its runs
/// to its verdict.
pub(super) fn explain(
    row: &RowName,
    stacks: &StackSet,
    power: Power,
    (shortcuts, resolution): (bool, &ResolutionOptions),
    options: &RunOptions,
    (format, command): (Format, &str),
) -> Result<ExitStatus, CliError> {
    row.code.check_compresses(stacks.others.bodies)?;
    let power = match row.code.accepts_any_convention() {
        true => power,
        false => row.code.law().power,
    };
    let stack = stacks.others.stack(row.mu, row.stiffness, power)?;
    let accepted = row.code.check_stiffness_ratio(stack.stiffness_ratio);
    accepted.map_err(as_flag)?;
    let codes = find_all(std::slice::from_ref(&row.code));
    let settled = match resolution.is_given() {
        true => settle_after_probes(&codes, options)?,
        false => settle(&codes, options)?,
    };
    let measurement = stacks.profile()?.measurement(&settled[0], &stack, power);
    let measurements = vec![with_options(measurement, shortcuts, resolution)];
    let settings = options.settings()?;
    let judgements = Campaign::new(&codes, &settings, &Reporter::new()).carry_out(measurements);
    let Some(judgement) = judgements.first() else {
        return Ok(ExitStatus::Interrupted);
    };
    let twin = measure_with_twin(&judgement.study, &settings, &Reporter::new());
    let twin = twin.map(|result| result.map_err(|error| error.to_string()));
    let coverage = codes[0].code.as_ref().map(|code| code.coverage());
    let (twin, coverage) = (twin.as_ref(), coverage.as_deref());
    let people = || wrapped_to_screen(explanation(judgement, twin, coverage));
    let printed = format.print(&explained(judgement, twin, coverage), command, people);
    if INTERRUPT.requested() {
        return Ok(ExitStatus::Interrupted);
    }
    Ok(ExitStatus::of(&judgements).max(printed))
}
