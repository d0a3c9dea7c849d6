//! Names of codes on the command line: built-in codes, folders by their path, and folders in the user's data
//! directory.

use crate::code::{Code, ManifestError, folder_argument};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Reads a code: its name, or the path of a folder with its manifest. A path contains a `/`. A path, or the name of a
/// folder in the user's data directory, ends in `:NAME` if the folder describes several codes.
#[derive(Debug, Clone, Copy)]
pub(super) struct CodeParser;

impl TypedValueParser for CodeParser {
    type Value = Code;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Code, clap::Error> {
        match code_named(&value.to_string_lossy()) {
            Some(found) => found.map_err(|error| {
                clap::Error::raw(ErrorKind::ValueValidation, format!("{error}\n")).with_cmd(command)
            }),
            None if Path::new(value).is_dir() => {
                let flag = argument.map_or_else(String::new, |argument| format!("{argument}: "));
                let message = format!("{flag}{}\n", unknown(&value.to_string_lossy()));
                Err(clap::Error::raw(ErrorKind::InvalidValue, message).with_cmd(command))
            }
            // The error lists the names.
            None => {
                let names = PossibleValuesParser::new(shown_names());
                names
                    .parse_ref(command, argument, value)
                    .map(|_| Code::native())
            }
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(shown_names().into_iter().map(PossibleValue::new)))
    }
}

/// The codes that one argument names.
#[derive(Debug, Clone)]
pub(super) struct CodeList(Vec<Code>);

impl CodeList {
    /// Returns the codes of several such arguments in their order.
    pub fn all(lists: &[Self]) -> Vec<Code> {
        let codes = lists.iter().flat_map(|list| &list.0);
        codes.cloned().collect()
    }
}

/// Reads codes that are separated by commas, each in the form of [`CodeParser`]. A path of an existing folder is that
/// folder, whatever commas it has.
#[derive(Debug, Clone, Copy)]
pub(super) struct CodeListParser;

impl TypedValueParser for CodeListParser {
    type Value = CodeList;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<CodeList, clap::Error> {
        let text = value.to_string_lossy();
        let words: Vec<&str> = match text.contains('/') && is_folder(&text) {
            true => vec![&text],
            false => text.split(',').collect(),
        };
        let read = |word: &&str| CodeParser.parse_ref(command, argument, OsStr::new(word));
        let codes: Result<_, _> = words.iter().map(read).collect();
        codes.map(CodeList).map_err(|error| {
            let Some(folder) = folder_with_comma(&text) else {
                return error;
            };
            let flag = argument.map_or_else(String::new, |argument| format!("{argument}: "));
            let message = format!(
                "{flag}`{text}` is a list with commas, and the name of the folder `{folder}` has a comma; accepted is its path \
                 alone, {}, and the flag again for other codes\n",
                folder_argument(&folder)
            );
            clap::Error::raw(ErrorKind::InvalidValue, message).with_cmd(command)
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        CodeParser.possible_values()
    }
}

/// Whether `text`, PATH or PATH:NAME, is the path of a folder that exists.
fn is_folder(text: &str) -> bool {
    let of_variant = text.rsplit_once(':').map(|(path, _)| path);
    let mut paths = [Some(text), of_variant].into_iter().flatten();
    paths.any(|path| Path::new(path).is_dir())
}

/// Returns the part of the list `text` that is a folder whose name has a comma, if there is one.
fn folder_with_comma(text: &str) -> Option<String> {
    let words: Vec<&str> = text.split(',').collect();
    let starts = 0..words.len();
    let mut runs = starts.flat_map(|start| {
        let ends = start + 2..=words.len();
        let words = &words;
        ends.map(move |end| words[start..end].join(","))
    });
    runs.find(|run| is_folder(run))
}

/// Returns the code that `text` names, in the form that [`CodeParser`] reads; `None` if no code has this name.
pub(super) fn code_named(text: &str) -> Option<Result<Code, ManifestError>> {
    let known = Code::named(text).map(Ok);
    let is_path = text.contains('/') || matches!(text, "." | "..");
    known.or_else(|| match is_path {
        true => Some(code_in_folder(text)),
        false => of_user(text),
    })
}

/// Returns the message for `text` that is not the name of a code.
pub(super) fn unknown(text: &str) -> String {
    let hint = match Path::new(text).is_dir() {
        true => format!("; did you mean the folder `./{text}`?"),
        false => String::new(),
    };
    format!(
        "`{text}` is no code{hint}; accepted are {}",
        shown_names().join(", ")
    )
}

/// Returns the names, and the form of a folder.
fn shown_names() -> Vec<String> {
    let mut names = names();
    names.push("./FOLDER".to_owned());
    names
}

/// Returns the names of the built-in codes and of the user's folders.
fn names() -> Vec<String> {
    let known = Code::built_in()
        .into_iter()
        .map(|code| code.as_str().to_owned());
    let folders = user_folders().into_iter().filter_map(|folder| {
        let name = folder.file_name()?.to_str()?;
        Some(name.to_owned())
    });
    let mut names: Vec<String> = known.collect();
    names.extend(folders.filter(|name| Code::named(name).is_none()));
    names
}

/// Reads the code in the folder at the path `text`, or in `PATH:NAME`.
pub(super) fn code_in_folder(text: &str) -> Result<Code, ManifestError> {
    in_folder(Path::new(""), text)
}

/// Reads the code that `text`, PATH or PATH:NAME, names below `directory`.
fn in_folder(directory: &Path, text: &str) -> Result<Code, ManifestError> {
    match text.rsplit_once(':') {
        Some((folder, name)) if !name.contains('/') => {
            Code::in_folder(&directory.join(folder), Some(name))
        }
        _ => Code::in_folder(&directory.join(text), None),
    }
}

/// Finds the code that `text` names in one of the user's folders, by the name of the folder or by its own.
fn of_user(text: &str) -> Option<Result<Code, ManifestError>> {
    let directory = user_directory()?;
    let folder = text.split(':').next().unwrap_or(text);
    if !folder.is_empty() && folder != ".." && directory.join(folder).is_dir() {
        return Some(in_folder(&directory, text));
    }
    // A broken folder does not keep the others from being found.
    let folders = user_folders().into_iter();
    let codes = folders.filter_map(|folder| Code::all_in_folder(&folder).ok());
    let mut codes = codes.flatten();
    codes.find(|code| code.as_str() == text).map(Ok)
}

/// Returns the directory of the user's folders.
fn user_directory() -> Option<PathBuf> {
    dirs::data_dir().map(|data| data.join("tristack").join("codes"))
}

/// Returns the user's folders, sorted by name.
fn user_folders() -> Vec<PathBuf> {
    let directory = user_directory().and_then(|directory| std::fs::read_dir(directory).ok());
    let entries = directory.into_iter().flatten().flatten();
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    folders.retain(|folder| folder.is_dir());
    folders.sort();
    folders
}

/// Returns the codes of this program and of the user's folders, and the errors of the other folders.
pub(super) fn known_codes() -> (Vec<Code>, Vec<ManifestError>) {
    let (mut known, mut errors) = (Code::built_in(), Vec::new());
    for folder in user_folders() {
        let read = Code::all_in_folder(&folder);
        match read.and_then(|own| Code::side_by_side(&[known.clone(), own].concat())) {
            Ok(all) => known = all,
            Err(error) => errors.push(error),
        }
    }
    (known, errors)
}
