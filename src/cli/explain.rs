//! `tristack crosscheck --explain ROW`.

use super::options::{RunOptions, as_flag, friction};
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::model::Stack;
use crate::output::explanation;
use crate::runs::SelectedCode;
use crate::study::Campaign;
use crate::study::yield_force::{measure_with_twin, plan};

/// One row of a crosscheck.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowName {
    code: Code,
    stack: Stack,
}

/// Reads CODE/MU/STIFFNESS.
pub fn row_name(text: &str) -> Result<RowName, String> {
    let parts: Vec<&str> = text.split('/').collect();
    let [code, mu, stiffness] = parts[..] else {
        return Err("accepted is CODE/MU/STIFFNESS, as in yade/0.3/100".to_owned());
    };
    let code = Code::named(code).ok_or_else(|| {
        let names: Vec<&str> = Code::all().into_iter().map(Code::as_str).collect();
        format!("`{code}` is no code; accepted are {}", names.join(", "))
    })?;
    let mu = friction(mu).map_err(|accepted| format!("MU is `{mu}`; {accepted}"))?;
    let stiffness: f64 = stiffness
        .parse()
        .map_err(|_| format!("STIFFNESS is `{stiffness}`; accepted is a number"))?;
    let stack = Stack::paper(mu, stiffness);
    stack
        .validate()
        .map_err(|error| as_flag(error).to_string())?;
    Ok(RowName { code, stack })
}

/// Measures one row and prints the whole chain from its runs to its verdict.
pub fn explain(row: &RowName, options: &RunOptions) -> Result<ExitStatus, CliError> {
    let selected = SelectedCode::find(row.code);
    let measurement = plan(row.code, &row.stack, row.code.convention());
    let settings = options.settings()?;
    let reporter = Reporter::new();
    let codes = [selected];
    let campaign = Campaign::new(&codes, &settings, &reporter);
    let judgements = campaign.carry_out(vec![measurement]);
    let Some(judgement) = judgements.first() else {
        return Ok(ExitStatus::Interrupted);
    };
    drop(campaign);
    drop(reporter);
    let twin = measure_with_twin(&judgement.study, &settings, &Reporter::new())
        .map(|result| result.map_err(|error| error.to_string()));
    let text = explanation(judgement, twin.as_ref());
    super::print(text.as_bytes())?;
    if INTERRUPT.requested() {
        return Ok(ExitStatus::Interrupted);
    }
    Ok(ExitStatus::of(&judgements))
}
