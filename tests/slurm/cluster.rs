//! A cluster on this machine: a munged, a slurmctld, and two nodes, each a slurmd in name spaces of its own, so that it has its
//! own host name and all its processes end with it. The nodes share one kernel, and so do the locks of files.

use super::common::Bench;
use std::fmt::Write;
use std::fs;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// In the environment: Slurm must be there, and must be allowed to run.
const REQUIRED: &str = "TRISTACK_REQUIRE_SLURM";
/// Debian has daemons where not every user looks for programs.
const PLACES: &str = "/usr/sbin:/usr/bin:/sbin:/bin";
/// Many times what anything takes, on a busy machine too; it ends a test that would hang.
const PATIENCE: Duration = Duration::from_secs(600);
pub const NODES: [&str; 2] = ["n1", "n2"];
/// The options with which `unshare` makes a node.
const NODE: [&str; 5] = ["--fork", "--kill-child", "--pid", "--mount-proc", "--uts"];

/// The running cluster, which ends when this is dropped.
pub struct Cluster<'a> {
    bench: &'a Bench,
    daemons: Vec<Child>,
    nodes: [Option<Child>; 2],
}

/// Whether there can be a cluster here; fails if TRISTACK_REQUIRE_SLURM is set and there cannot.
pub fn is_possible() -> bool {
    let missing = missing();
    if let Some(missing) = &missing {
        assert!(
            std::env::var_os(REQUIRED).is_none(),
            "no cluster: {missing}"
        );
        eprintln!("skipped: no cluster: {missing}");
    }
    missing.is_none()
}

fn missing() -> Option<String> {
    let found = |program: &&str| {
        PLACES
            .split(':')
            .any(|place| fs::exists(format!("{place}/{program}")).unwrap_or(false))
    };
    let programs = [
        "munged",
        "slurmctld",
        "slurmd",
        "sbatch",
        "unshare",
        "setpriv",
    ];
    if let Some(program) = programs.into_iter().find(|program| !found(program)) {
        return Some(format!("{program} is not installed"));
    }
    let mut trial = Command::new("unshare");
    trial
        .args(NODE)
        .args(["hostname", "n1"])
        .stderr(Stdio::null());
    let allowed =
        nix::unistd::geteuid().is_root() && trial.status().is_ok_and(|status| status.success());
    (!allowed).then(|| "slurmd needs root, and its nodes need name spaces".to_owned())
}

impl<'a> Cluster<'a> {
    /// Starts the cluster in directories of `bench`, and waits until both nodes take jobs.
    pub fn start(bench: &'a Bench) -> Self {
        let mut cluster = Self {
            bench,
            daemons: Vec::new(),
            nodes: [None, None],
        };
        cluster.write_files();
        let path = |name: &str| bench.path(name).display().to_string();
        let munged = [
            "munged".to_owned(),
            "--foreground".to_owned(),
            "--force".to_owned(),
            format!("--key-file={}", path("slurm/key")),
            format!("--socket={}", path("slurm/socket")),
            format!("--pid-file={}", path("slurm/munged.pid")),
            format!("--log-file={}", path("slurm/munged.log")),
            format!("--seed-file={}", path("slurm/seed")),
        ];
        cluster.daemons.push(cluster.spawn("munged", &munged));
        cluster.wait_for("munged answers", || bench.path("slurm/socket").exists());
        let slurmctld = ["slurmctld", "-D", "-c"].map(str::to_owned);
        cluster.daemons.push(cluster.spawn("slurmctld", &slurmctld));
        for node in NODES {
            cluster.boot(node);
        }
        cluster
    }

    fn write_files(&self) {
        let root = self.bench.path("slurm");
        for directory in ["state", "spool-n1", "spool-n2"] {
            fs::create_dir_all(root.join(directory)).expect("a directory");
        }
        let key = root.join("key");
        let random: Vec<u8> = std::iter::repeat_with(|| fastrand::u8(..))
            .take(128)
            .collect();
        fs::write(&key, random).expect("a key");
        fs::set_permissions(&key, fs::Permissions::from_mode(0o400)).expect("its permissions");
        fs::write(self.configuration(), self.settings()).expect("a configuration");
    }

    fn configuration(&self) -> PathBuf {
        self.bench.path("slurm/slurm.conf")
    }

    /// Requeued jobs wait for `cred_expire` seconds. Nodes have one core, so that each gets one task.
    fn settings(&self) -> String {
        let root = self.bench.path("slurm").display().to_string();
        let host = fs::read_to_string("/proc/sys/kernel/hostname").expect("a name");
        let host = host.trim();
        // Held together, so that they differ.
        let listeners = [(); 3].map(|()| TcpListener::bind("127.0.0.1:0").expect("a free port"));
        let [control, one, other] = listeners.map(|it| it.local_addr().expect("an address").port());
        let mut settings = format!(
            "ClusterName=test\nSlurmctldHost={host}(127.0.0.1)\nSlurmctldPort={control}\nSlurmUser=root\nSlurmdUser=root\n\
             AuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket={root}/socket,cred_expire=3\n\
             StateSaveLocation={root}/state\nSlurmdSpoolDir={root}/spool-%n\n\
             SlurmctldPidFile={root}/slurmctld.pid\nSlurmdPidFile={root}/slurmd-%n.pid\n\
             ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\nSwitchType=switch/none\n\
             SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\nReturnToService=2\n\
             SchedulerParameters=sched_interval=1,batch_sched_delay=0\n"
        );
        for (node, port) in NODES.into_iter().zip([one, other]) {
            writeln!(
                settings,
                "NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1"
            )
            .expect("a line");
        }
        settings + "PartitionName=all Nodes=n[1-2] Default=YES MaxTime=60 State=UP\n"
    }

    /// Starts a daemon, which ends with this program, however that ends.
    fn spawn(&self, name: &str, words: &[String]) -> Child {
        let log = fs::File::create(self.bench.path(&format!("slurm/{name}.txt"))).expect("a file");
        let mut command = self.command("setpriv");
        command.args(["--pdeathsig", "KILL", "--"]).args(words);
        command.stdout(log.try_clone().expect("a file")).stderr(log);
        command.stdin(Stdio::null()).spawn().expect("it starts")
    }

    /// A program that finds the cluster.
    pub fn command(&self, program: &str) -> Command {
        let mut command = self.bench.process_of(program.as_ref(), "");
        let path = format!("{}:{PLACES}", self.bench.path("programs").display());
        command
            .env("PATH", path)
            .env("SLURM_CONF", self.configuration());
        command
    }

    /// What `line`, a program and its arguments, prints.
    #[track_caller]
    pub fn ask(&self, line: &str) -> String {
        let mut words = line.split_whitespace();
        let mut command = self.command(words.next().expect("a program"));
        let output = command.args(words).output().expect("it starts");
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}: {error}\n{}", self.logs());
        String::from_utf8(output.stdout).expect("text")
    }

    /// Starts a node, and waits until it takes jobs.
    pub fn boot(&mut self, node: &str) {
        let mut words = vec!["unshare".to_owned()];
        words.extend(NODE.map(str::to_owned));
        let script = format!("hostname {node} && exec slurmd -D -N {node}");
        words.extend(["sh".to_owned(), "-c".to_owned(), script]);
        self.nodes[place(node)] = Some(self.spawn(node, &words));
        let states = format!("sinfo --noheader --nodes={node} --format=%t");
        self.wait_for("the node is idle", || {
            let mut command = self.command("sinfo");
            let output = command.args(states.split(' ').skip(1)).output();
            output.is_ok_and(|output| output.stdout.trim_ascii() == b"idle")
        });
    }

    /// Waits until `condition` holds, which is `said` in words.
    #[track_caller]
    pub fn wait_for(&self, said: &str, condition: impl Fn() -> bool) {
        let start = Instant::now();
        while !condition() {
            assert!(
                start.elapsed() < PATIENCE,
                "waited in vain until {said}\n{}",
                self.logs()
            );
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// Ends a node as if its power failed, and tells Slurm, which would notice by itself after minutes.
    pub fn kill(&mut self, node: &str) {
        end(self.nodes[place(node)].take().expect("it runs"));
        self.ask(&format!(
            "scontrol update nodename={node} state=down reason=died"
        ));
    }

    /// What the daemons have written.
    pub fn logs(&self) -> String {
        let names = ["munged", "slurmctld"].into_iter().chain(NODES);
        let texts = names.map(|name| {
            let path = self.bench.path(&format!("slurm/{name}.txt"));
            format!(
                "== {name}\n{}",
                fs::read_to_string(path).unwrap_or_default()
            )
        });
        texts.collect()
    }
}

fn place(node: &str) -> usize {
    NODES.iter().position(|name| *name == node).expect("a node")
}

/// Kills a daemon; a node is the first process of a name space, and all others there end with it.
fn end(mut daemon: Child) {
    let _ = daemon.kill();
    let _ = daemon.wait();
}

impl Drop for Cluster<'_> {
    fn drop(&mut self) {
        let nodes = self.nodes.iter_mut().filter_map(Option::take);
        nodes.chain(self.daemons.drain(..)).for_each(end);
    }
}
