//! Lists of runs to be started elsewhere: for a shell, for GNU parallel, and for Slurm.

use crate::code::PlannedRun;
use crate::model::shell_quoted;
use std::time::Duration;

/// Minimum duration of a task of a Slurm array, in seconds, by forecast: starting a task takes as long.
const SECONDS_OF_A_TASK: f64 = 60.0;
/// Maximum number of tasks in an array, unless Slurm is configured otherwise (its default `MaxArraySize` is 1001).
const MOST_TASKS: usize = 1000;

/// Returns one line per run, each run in a subshell of its own.
pub fn start_list(runs: &[&PlannedRun]) -> String {
    let lines = runs.iter().map(|run| format!("({})\n", start(run)));
    lines.collect()
}

/// Returns the list for `parallel < parallel.txt`, longest run first; `parallel` gives each line a shell of its own.
pub fn parallel_list(runs: &[&PlannedRun]) -> String {
    let mut runs = runs.to_vec();
    runs.sort_by(|one, other| other.seconds.total_cmp(&one.seconds));
    let lines = runs.iter().map(|run| start(run) + "\n");
    lines.collect()
}

/// Returns the shell command that changes to the directory of the run and starts it.
fn start(run: &PlannedRun) -> String {
    let directory = shell_quoted(&run.directory);
    let variables = run.environment.iter();
    let variables = variables.map(|(name, value)| shell_quoted(&format!("{name}={value}")));
    let words = run.command.iter().map(|word| shell_quoted(word));
    let words: Vec<String> = variables.chain(words).collect();
    let command = match run.environment.is_empty() {
        true => words.join(" "),
        false => format!("env {}", words.join(" ")),
    };
    format!("cd {directory} && {command} > stdout.txt 2> stderr.txt")
}

/// Returns a Slurm array script. It contains all runs, so that a waiting array does not see a later plan. A run is
/// given up after the time that `limit` returns for it.
pub fn slurm_array(
    name: &str,
    runs: &[&PlannedRun],
    limit: impl Fn(&PlannedRun) -> Duration,
) -> String {
    let tasks = array_tasks(runs);
    if tasks.is_empty() {
        return "#!/bin/sh\n# Every run has a result.\n".to_owned();
    }
    let longest = tasks.iter().map(|task| {
        let limits = task.iter().map(|run| limit(run).as_secs_f64());
        limits.sum::<f64>()
    });
    let minutes = (longest.fold(0.0, f64::max) / 60.0).ceil().max(1.0);
    let cases = (1..).zip(&tasks).map(|(index, task)| {
        let lines = start_list(task);
        format!("{index})\n{lines};;\n")
    });
    format!(
        "#!/bin/sh\n\
         # Submit it in this directory: sbatch array.slurm\n\
         #SBATCH --job-name=tristack-{name}\n\
         #SBATCH --array=1-{}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task=1\n\
         #SBATCH --time={minutes}\n\
         #SBATCH --output={}/slurm-%A-%a.txt\n\
         case \"$SLURM_ARRAY_TASK_ID\" in\n{}esac\n",
        tasks.len(),
        top_directory(tasks[0][0]),
        cases.collect::<String>()
    )
}

/// Returns the top directory of a run, in the directory of the plan. It exists already; Slurm creates no directory
/// for its output.
fn top_directory(run: &PlannedRun) -> &str {
    let (top, _) = run.directory.split_once('/').unwrap_or((".", ""));
    top
}

/// Groups the runs into the tasks of an array, in their order.
fn array_tasks<'a>(runs: &[&'a PlannedRun]) -> Vec<Vec<&'a PlannedRun>> {
    let all: f64 = runs.iter().map(|run| run.seconds).sum();
    let enough = SECONDS_OF_A_TASK.max(all / MOST_TASKS as f64);
    let mut tasks: Vec<Vec<&PlannedRun>> = Vec::new();
    let mut filled = 0.0;
    for &run in runs {
        match tasks.last_mut().filter(|_| filled < enough) {
            Some(task) => task.push(run),
            None => {
                tasks.push(vec![run]);
                filled = 0.0;
            }
        }
        filled += run.seconds;
    }
    tasks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::PlannedTask;
    use crate::model::{ContactConvention, ContactTest, InitialMotion};
    use std::collections::BTreeMap;

    fn run(directory: &str, seconds: f64) -> PlannedRun {
        let test = ContactTest {
            convention: ContactConvention::TURNING,
            stiffness_ratio: 1.0,
            floor_friction: 0.5,
            cylinder_friction: 0.5,
            time_step: 0.1,
            steps: 1,
            wall_height: 9.0,
            wall_speed: 0.0,
            initial_motions: [InitialMotion::at(0.0, 2.0), InitialMotion::at(6.0, 2.0)],
            drive: None,
            space: None,
        };
        PlannedRun {
            directory: directory.to_owned(),
            deck_hash: String::new(),
            files: BTreeMap::new(),
            command: ["dem", "it's", "$HOME"].map(str::to_owned).into(),
            environment: BTreeMap::from([("A".to_owned(), "b c".to_owned())]),
            result: "result.csv".to_owned(),
            steps: 1,
            seconds,
            task: PlannedTask::Motion(test),
        }
    }

    #[test]
    fn a_shell_takes_every_word_as_it_is() {
        let run = run("runs/a b", 1.0);
        assert_eq!(
            start_list(&[&run]),
            "(cd 'runs/a b' && env 'A=b c' dem 'it'\\''s' '$HOME' > stdout.txt 2> stderr.txt)\n"
        );
    }

    #[test]
    fn parallel_starts_with_the_longest() {
        let runs = [run("short", 1.0), run("long", 2.0)];
        let list = parallel_list(&[&runs[0], &runs[1]]);
        assert!(list.starts_with("cd long && env"), "{list}");
        assert_eq!(list.lines().count(), 2);
    }

    #[test]
    fn tasks_of_an_array_are_long_enough_and_not_too_many() {
        let sizes = |seconds: f64, count: usize| {
            let run = run("a", seconds);
            let tasks = array_tasks(&vec![&run; count]);
            let sizes: Vec<usize> = tasks.iter().map(Vec::len).collect();
            assert_eq!(sizes.iter().sum::<usize>(), count);
            sizes
        };
        assert_eq!(sizes(25.0, 7), [3, 3, 1]);
        assert_eq!(sizes(100.0, 3), [1, 1, 1]);
        assert!(sizes(100.0, 2500).len() <= MOST_TASKS);
        assert!(sizes(1.0, 0).is_empty());
    }

    #[test]
    fn a_slurm_array_has_a_case_for_every_task_and_time_for_the_longest() {
        let runs = [run("a", 50.0), run("b", 50.0), run("c", 50.0)];
        let runs: Vec<&PlannedRun> = runs.iter().collect();
        let script = slurm_array("dem", &runs, |_| Duration::from_secs(100));
        assert!(script.contains("--array=1-2\n"), "{script}");
        assert!(script.contains("--time=4\n"), "{script}");
        assert!(script.contains("\n2)\n(cd c && "), "{script}");
    }
}
