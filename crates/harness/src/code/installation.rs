//! The program of a code as it is installed here: its file and its version.

use super::broken::BrokenCode;
use super::covered::CoveredFiles;
use super::definition::LONGEST_START;
use super::described::Code;
use super::failure::FailureKind;
use super::installed::InstalledCode;
use super::manifest::{Definition, Environment, Program, TaskKind, VersionQuestion};
use super::provenance::Identity;
use super::question::answer;
use super::search_path::find_program;
use crate::model::{readable, shown};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Longest version in characters, as it is printed in tables.
const LONGEST_VERSION: usize = 100;
const UNKNOWN: &str = "unknown";

/// An external code whose program is installed.
pub(crate) struct ExternalCode {
    pub name: Code,
    /// First word of the command: that of the manifest, or a build in another precision.
    word: String,
    /// The file that was found.
    pub file: PathBuf,
    pub identity: Identity,
    /// The files that decide what it computes.
    covered: CoveredFiles,
}

impl ExternalCode {
    /// Finds the program `word` of the code `name` where the manifest says, and asks the package manager or the
    /// program itself for the version. A program that gives no answer within [`LONGEST_START`], or is ended by a
    /// signal, is broken: its runs would be kept under a wrong name.
    pub fn find(name: &Code, word: &str) -> Option<Box<dyn InstalledCode>> {
        let program = name.definition().program.as_ref()?;
        let directories = program
            .search
            .iter()
            .map(|directory| directory.get_ref().as_str());
        let file = find_program(directories, word)?;
        Some(match identify(&file, program) {
            Ok(version) => Box::new(Self::identified(name, program, word, file, version)),
            Err(kind) => Box::new(BrokenCode::new(name.clone(), &file, &kind)),
        })
    }

    fn identified(
        name: &Code,
        program: &Program,
        word: &str,
        file: PathBuf,
        (version, package): (String, Option<String>),
    ) -> Self {
        let arguments = program.command.get(1..).unwrap_or_default();
        let decks = name.definition().decks();
        let covered = CoveredFiles::of(&file, arguments, &program.environment, decks);
        let mut code = Self {
            word: word.to_owned(),
            identity: Identity {
                code: name.as_str().to_owned(),
                version,
                package,
                program_hash: covered.hash(&file).cloned(),
                files_hash: Some(covered.digest()),
                witness: None,
            },
            file,
            covered,
            name: name.clone(),
        };
        code.identity.witness = code.witness();
        code
    }

    /// The manifest of the code.
    pub fn definition(&self) -> &Definition {
        self.name.definition()
    }

    /// Its program.
    pub fn program(&self) -> &Program {
        let program = self.definition().program.as_ref();
        program.expect("a code without a program is not looked for")
    }

    /// Refuses the program if it, or a file that it depends on, has been replaced since it was found.
    pub fn check_unchanged(&self) -> Result<(), FailureKind> {
        let changed = self.covered.changed().cloned();
        changed.map_or(Ok(()), |path| Err(FailureKind::Replaced(path)))
    }

    /// Says what the identity covers and what it does not.
    pub fn described_coverage(&self) -> String {
        let (files, libraries) = self.covered.counts();
        let witness = match &self.identity.witness {
            Some(digest) => format!(
                "a micro-test made in this session, to ten digits ({})",
                &digest[..12]
            ),
            None => "no micro-test: the program takes too long to start, or has none".to_owned(),
        };
        format!(
            "{}, and {} other files that it names or maps, {libraries} of them libraries; {witness}; all files of its \
             folder. Not covered: what it finds only while it runs, such as plugins, the modules that come with an \
             interpreter, and data",
            shown(&self.file),
            files.saturating_sub(1)
        )
    }

    /// Returns the program and the arguments that carry out tasks of one kind in `directories`.
    pub fn command(&self, kind: TaskKind, directories: &[String]) -> Vec<String> {
        let mut command = self.definition().command(kind, directories);
        command[0].clone_from(&self.word);
        command
    }
}

/// Determines the version of the program in `file`, and the package that it belongs to.
fn identify(file: &Path, program: &Program) -> Result<(String, Option<String>), FailureKind> {
    let question = &program.version;
    let package = owning_package(file)?;
    let version = match &package {
        Some((_, version)) if question.package => upstream(version).to_owned(),
        _ => own_version(file, question, &program.environment)?,
    };
    Ok((
        version,
        package.map(|(package, version)| format!("{package} {version}")),
    ))
}

/// Returns the name and the version of the Debian package that owns the program, links followed.
fn owning_package(program: &Path) -> Result<Option<(String, String)>, FailureKind> {
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
) -> Result<String, FailureKind> {
    if question.arguments.is_empty() {
        return Ok(UNKNOWN.to_owned());
    }
    let mut command = vec![program.as_os_str().to_owned()];
    command.extend(question.arguments.iter().map(OsString::from));
    let text = answer(&command, environment, LONGEST_START)?.unwrap_or_default();
    Ok(version_in_answer(&text, &question.before))
}

/// Extracts the version from the `answer` of a program: the first line that is not blank, from after `before` up to a
/// comma; `unknown` if nothing there is readable.
pub fn version_in_answer(answer: &str, before: &str) -> String {
    let first = answer.lines().find(|line| !line.trim().is_empty());
    let line = first.unwrap_or_default().trim();
    let rest = line.strip_prefix(before).unwrap_or(line);
    let version = rest.split(',').next().unwrap_or(rest);
    let version: String = version.chars().filter(|char| !char.is_control()).collect();
    let version: String = readable(&version).chars().take(LONGEST_VERSION).collect();
    match version.trim() {
        "" => UNKNOWN.to_owned(),
        version => version.to_owned(),
    }
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

    #[test]
    fn a_program_that_does_not_exist_is_not_installed() {
        let code = Code::named("yade").unwrap();
        assert!(ExternalCode::find(&code, "tristack-has-no-such-code").is_none());
    }
}
