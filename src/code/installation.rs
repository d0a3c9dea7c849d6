//! The program of a code as it is installed here: its file and its version.

use super::definition::LONGEST_START;
use super::failure::FailureKind;
use super::manifest::{Definition, Environment, Program, TaskKind, VersionQuestion};
use super::process::{Interrupt, Job, run};
use super::provenance::Identity;
use super::registry::Code;
use crate::files::{Links, read_bounded};
use crate::model::sha256_hex;
use nix::unistd::{AccessFlags, access};
use std::ffi::OsString;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Attempts at a query that a signal ends: the answer becomes part of the address of every run.
const TRIES: usize = 3;

/// Largest file of a program that is read, in bytes.
const LARGEST_PROGRAM: u64 = 1 << 32;
/// Longest version in characters, as it is printed in tables.
const LONGEST_VERSION: usize = 100;
const UNKNOWN: &str = "unknown";

/// Device and number of a file, and when it last changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stamp([i64; 4]);

impl Stamp {
    fn of(path: &Path) -> Option<Self> {
        let data = std::fs::metadata(path).ok()?;
        let place = [data.dev() as i64, data.ino() as i64];
        Some(Self([place[0], place[1], data.ctime(), data.ctime_nsec()]))
    }
}

/// An external code whose program is installed.
pub(crate) struct ExternalCode {
    pub name: Code,
    pub definition: &'static Definition,
    pub program: &'static Program,
    /// First word of the command: that of the manifest, or a build in another precision.
    word: String,
    /// The file that was found.
    pub file: PathBuf,
    pub identity: Identity,
    /// Changes when the file is written to or replaced.
    stamp: Stamp,
}

impl ExternalCode {
    /// The code `name` with the program `word`, looked for in the search path. The package manager or the program itself
    /// is asked for the version; a program that gives none within [`LONGEST_START`] counts as not installed: its
    /// runs would be kept under a wrong name.
    pub fn find(name: Code, word: &str) -> Option<Self> {
        let definition = name.definition();
        let program = definition.program.as_ref()?;
        let question = &program.version;
        let file = in_search_path(word)?;
        let stamp = Stamp::of(&file)?;
        let package = owning_package(&file).ok()?;
        let version = match &package {
            Some((_, version)) if question.package => upstream(version).to_owned(),
            _ => own_version(&file, question, &program.environment).ok()?,
        };
        let hash = sha256_hex(&read_bounded(&file, LARGEST_PROGRAM, Links::Followed).ok()?);
        Some(Self {
            name,
            definition,
            program,
            word: word.to_owned(),
            file,
            identity: Identity {
                code: name.as_str().to_owned(),
                version,
                package: package.map(|(package, version)| format!("{package} {version}")),
                program_hash: Some(hash),
            },
            stamp,
        })
    }

    /// Refuses a program that has been replaced since it was found.
    pub fn check_unchanged(&self) -> Result<(), FailureKind> {
        let unchanged = Stamp::of(&self.file) == Some(self.stamp);
        let replaced = || FailureKind::Replaced(self.file.clone());
        unchanged.then_some(()).ok_or_else(replaced)
    }

    /// Program and arguments that carry out tasks of one kind in `directories`.
    pub fn command(&self, kind: TaskKind, directories: &[String]) -> Vec<String> {
        let mut command = self.definition.command(kind, directories);
        command[0].clone_from(&self.word);
        command
    }
}

fn in_search_path(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .filter_map(|directory| std::path::absolute(directory.join(program)).ok())
        .find(|candidate| candidate.is_file() && access(candidate, AccessFlags::X_OK).is_ok())
}

/// Debian package and version that the program, links followed, belongs to.
fn owning_package(program: &Path) -> Result<Option<(String, String)>, TooSlow> {
    let ask = |arguments: Vec<OsString>| {
        let mut command = vec![OsString::from("dpkg-query")];
        command.extend(arguments);
        answer(&command, &Environment::new(), LONGEST_START)
    };
    let Ok(resolved) = program.canonicalize() else {
        return Ok(None);
    };
    let owner = ask(vec!["--search".into(), resolved.into_os_string()])?;
    let name = owner.and_then(|owner| Some(owner.lines().next()?.split(':').next()?.to_owned()));
    let Some(name) = name else {
        return Ok(None);
    };
    let format = "--showformat=${Version}";
    let version = ask(vec!["--show".into(), format.into(), name.clone().into()])?;
    Ok(version.map(|version| (name, version)))
}

/// The upstream part of a Debian version, without epoch, repackaging suffix and revision.
fn upstream(version: &str) -> &str {
    let version = version.split_once(':').map_or(version, |(_, rest)| rest);
    let version = version
        .rsplit_once('-')
        .map_or(version, |(upstream, _)| upstream);
    version
        .split_once('+')
        .map_or(version, |(upstream, _)| upstream)
}

fn own_version(
    program: &Path,
    question: &VersionQuestion,
    environment: &Environment,
) -> Result<String, TooSlow> {
    if question.arguments.is_empty() {
        return Ok(UNKNOWN.to_owned());
    }
    let mut command = vec![program.as_os_str().to_owned()];
    command.extend(question.arguments.iter().map(OsString::from));
    let text = answer(&command, environment, LONGEST_START)?.unwrap_or_default();
    Ok(version_in_answer(&text, &question.before))
}

/// The version in the `answer` of a program: its first line from behind `before` to a comma; `unknown` if nothing
/// there is readable.
pub fn version_in_answer(answer: &str, before: &str) -> String {
    let first = answer.lines().find(|line| !line.trim().is_empty());
    let line = first.unwrap_or_default().trim();
    let rest = line.strip_prefix(before).unwrap_or(line);
    let version = rest.split(',').next().unwrap_or(rest);
    let readable = version.chars().filter(|char| !char.is_control());
    let version: String = readable.take(LONGEST_VERSION).collect();
    match version.trim() {
        "" => UNKNOWN.to_owned(),
        version => version.to_owned(),
    }
}

/// There was no answer within the time limit.
#[derive(Debug)]
struct TooSlow;

/// The standard output of `command`; `None` if it fails or cannot be started.
fn answer(
    command: &[OsString],
    environment: &Environment,
    time_limit: Duration,
) -> Result<Option<String>, TooSlow> {
    let job = Job {
        command,
        directory: Path::new("/"),
        // A query leaves no files behind.
        home: Path::new("/nonexistent"),
        environment,
        time_limit,
        interrupt: &Interrupt::new(),
    };
    for _ in 0..TRIES {
        match run(&job, Vec::new(), std::io::sink(), || false) {
            Ok((status, text)) if status.code().is_some() => {
                let text = String::from_utf8_lossy(&text.unwrap_or_default()).into_owned();
                return Ok(status.success().then_some(text));
            }
            Ok(_) => {}
            Err(FailureKind::TimedOut(_)) => return Err(TooSlow),
            Err(_) => return Ok(None),
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn upstream_version_is_what_the_authors_call_it() {
        assert_eq!(upstream("3.8.0+repack1-9+b2"), "3.8.0");
        assert_eq!(upstream("2023.02a-1"), "2023.02a");
        assert_eq!(upstream("1:29Sep2021+ds-1"), "29Sep2021");
    }

    fn ask(command: &[&str]) -> Result<Option<String>, TooSlow> {
        let command: Vec<OsString> = command.iter().map(OsString::from).collect();
        answer(&command, &Environment::new(), Duration::from_secs(1))
    }

    #[test]
    fn only_a_program_that_ends_by_itself_has_answered() {
        assert_eq!(ask(&["echo", "1.2"]).unwrap().as_deref(), Some("1.2\n"));
        assert_eq!(ask(&["false"]).unwrap(), None);
        assert!(ask(&["sleep", "60"]).is_err());
    }

    #[test]
    fn a_program_that_does_not_exist_is_not_installed() {
        let code = Code::named("yade").unwrap();
        assert!(ExternalCode::find(code, "tristack-has-no-such-code").is_none());
    }
}
