//! What a folder does that misbehaves, and what it leaves in a plan.

use super::fault::FolderFault as F;
use nix::sys::stat::Mode;
use nix::unistd::mkfifo;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

/// Commands of the shell that a folder executes before it answers.
pub fn command(fault: F, random: &mut fastrand::Rng) -> &'static str {
    let choices: &[&'static str] = match fault {
        F::Hangs => &["sleep 600", "while :; do :; done", "kill -STOP $$"],
        F::WritesOutside => &[
            "for place in .. \"$HOME\" \"$TMPDIR\"; do echo x > \"$place/outside\"; done",
            "for other in ../*/; do echo x > \"$other/outside\"; done; echo x > \"$HOME/../outside\"",
            "chmod -R 0 \"$HOME\" .. ; chmod 700 ..",
        ],
        F::FloodsOutput => &[
            "head -c 2G /dev/zero; head -c 100M /dev/zero >&2",
            "yes mydem | head -c 500M >&2",
        ],
        F::FloodsFiles => &[
            "head -c 100M /dev/zero > junk; for i in $(seq 2000); do : > junk$i; done",
            "truncate -s 2G junk || exit 1",
            "truncate -s 900M result.csv; exit 0",
            "mkdir -p $(seq -s / 500)",
        ],
        F::FloodsMemory => &["python3 -c 'bytes(12 << 30)' || exit 1"],
        F::LeavesChildren => &[
            "setsid sleep 600 & (setsid sh -c 'sleep 600 & sleep 600' &)",
            "for i in $(seq 100); do sleep 600 & done",
            "(trap '' TERM HUP INT; setsid sh -c \"trap '' TERM; sleep 600; sleep 600\" &)",
        ],
        F::LiesAboutItsVersion => &[
            "echo \"mydem $(date +%N)\"; exit 0",
            "yes mydem 1.0 | head -c 300M; exit 0",
            "printf 'mydem 1\\033[2J\\342\\200\\256,agrees\\n'; exit 0",
            "echo mydem; exit 0",
        ],
    };
    choices[random.usize(..choices.len())]
}

/// Puts into a plan what a folder has left in the run at `result`, whose task is at `given`: another run's is at `other`.
pub fn leave(fault: F, result: &Path, given: &Path, other: &Path) {
    let _ = fs::remove_file(result);
    let sparse = |length: u64| {
        let file = fs::File::create(result).expect("a file");
        file.set_len(length).expect("a length");
    };
    match fault {
        F::Hangs => mkfifo(result, Mode::S_IRWXU).expect("a named pipe"),
        F::WritesOutside => {
            fs::copy(other, result).expect("a result");
            fs::write(given, "{}").expect("a task");
        }
        F::FloodsOutput => symlink("/dev/zero", result).expect("a link"),
        F::FloodsFiles => sparse(2 << 30),
        F::FloodsMemory => fs::write(result, "9".repeat(50_000_000)).expect("a file"),
        F::LeavesChildren => symlink(other, result).expect("a link"),
        F::LiesAboutItsVersion => {
            let text = fs::read_to_string(other).expect("a result");
            fs::write(result, text.replacen('1', "one", 3)).expect("a result");
        }
    }
}

/// Whether a command may succeed, with the honest result, although the folder does this.
pub fn may_pass(fault: F, stage: &str) -> bool {
    match fault {
        F::Hangs => false,
        F::FloodsMemory => stage == "version",
        F::WritesOutside
        | F::FloodsOutput
        | F::FloodsFiles
        | F::LeavesChildren
        | F::LiesAboutItsVersion => true,
    }
}
