//! The round-off in the error budget, held against twins that compute with more digits.

use tristack::code::{Code, InstalledCode, Interrupt, RunContext};
use tristack::model::{CRITICAL_FRICTION, Stack};
use tristack::series::YieldEstimates;
use tristack::study::yield_force::{Extrapolation, extrapolate, plan};

fn slip(code: &dyn InstalledCode, stack: &Stack) -> Extrapolation {
    let settled = code.name().as_declared().expect("nothing is left out");
    let cases = plan(&settled, stack, settled.convention()).cases;
    let directory = tempfile::tempdir().expect("a directory");
    let interrupt = Interrupt::new();
    let context = RunContext::new(directory.path(), &interrupt);
    let mut estimates = vec![None; cases.len()];
    code.run(&cases, &context, &mut |index, result| {
        let run = result.expect("it delivers");
        estimates[index] = Some(YieldEstimates::read(&run.series, &run.case));
    });
    let estimates: Vec<YieldEstimates> = estimates.into_iter().flatten().collect();
    let steps: Vec<u64> = cases.iter().map(|case| case.total_steps()).collect();
    extrapolate(&estimates, &steps, stack.stiffness, |run| run.slip).expect("a slip")
}

/// Round-off found by the twin, as a part of what the budget says.
fn part_of_budget(code: Code, stack: &Stack) -> Option<f64> {
    let (code, twin) = (code.find()?, code.find_precise()?);
    let (double, precise) = (slip(code.as_ref(), stack), slip(twin.as_ref(), stack));
    let found = (double.force - precise.force).abs();
    println!(
        "{} mu = {}, stiffness = {}: round-off {found:.1e}, in the budget {:.1e}",
        code.name(),
        stack.floor_friction,
        stack.stiffness,
        double.budget.round_off
    );
    Some(found / double.budget.round_off)
}

/// Not above the budget anywhere; and the budget is no more than a hundred times what is found somewhere.
fn assert_fair(code: Code, stacks: &[Stack]) {
    let parts: Vec<f64> = stacks
        .iter()
        .filter_map(|stack| part_of_budget(code.clone(), stack))
        .collect();
    if parts.is_empty() {
        eprintln!("{code} or its twin is not installed: skipped");
        return;
    }
    let largest = parts.iter().copied().fold(0.0, f64::max);
    assert!((0.01..1.0).contains(&largest), "{code}: {parts:?}");
}

#[test]
fn native_is_within_its_round_off_of_a_double_double_twin() {
    let stacks = [
        Stack::paper(0.2, 1e2),
        Stack::paper(0.3, 1e3),
        Stack::paper(0.2, 1e4),
        Stack::paper(CRITICAL_FRICTION, 1e4),
    ];
    assert_fair(Code::native(), &stacks);
}

#[test]
fn yade_is_within_its_round_off_of_a_long_double_twin() {
    let stacks = [Stack::paper(0.2, 1e2), Stack::paper(0.2, 1e4)];
    assert_fair(Code::named("yade").expect("it is built in"), &stacks);
}
