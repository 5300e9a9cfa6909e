//! Processes that are ended with everything they started.
//!
//! On Unix a program is the leader of a process group of its own, and it is the group that is
//! killed: when its [`Group`] is dropped, and on Ctrl-C. The leader is reaped after the kill, so its
//! number still names this group. What leaves the group by `setsid` is killed last, on Linux, where the
//! judge adopts it; elsewhere that is out of reach, and where there are no groups the program alone is killed.
//!
//! A judge of many programs starts a judge for each of them ([`Group::start_judge`]) and adopts nothing. A program
//! can then signal its parent, and the parent that it gets when that one has ended, without reaching the first judge.

use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Groups to be killed on Ctrl-C; nothing once that has happened, and then nothing starts any more.
static LIVE: Mutex<Option<Vec<Live>>> = Mutex::new(Some(Vec::new()));

/// How long a judge has to end what it has started.
#[cfg(unix)]
const TIME_TO_END: Duration = Duration::from_secs(2);

#[derive(Clone, Copy)]
struct Live {
    leader: u32,
    /// Whether it is a judge, which ends its own groups when it receives SIGTERM.
    is_judge: bool,
}

impl Live {
    fn end(self) {
        if self.is_judge {
            terminate(self.leader);
        }
        kill(self.leader);
    }
}

pub struct Group {
    child: Child,
    ended: Option<ExitStatus>,
    is_judge: bool,
}

impl Group {
    /// Starts a command as it is given, without a shell.
    ///
    /// # Errors
    /// What the system says, or that the judge is being stopped.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        Self::begin(command, false)
    }

    /// Starts a process that calls [`end_all_on_ctrl_c`] and [`end_with_parent`] before it starts others.
    ///
    /// # Errors
    /// If the system cannot start it, as [`Group::start`].
    pub fn start_judge(command: &mut Command) -> io::Result<Self> {
        Self::begin(command, true)
    }

    fn begin(command: &mut Command, is_judge: bool) -> io::Result<Self> {
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        // Held while it starts, so that Ctrl-C finds it or it does not start.
        let mut live = LIVE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let live = live.as_mut().ok_or_else(|| io::Error::other("the judge is being stopped"))?;
        let child = command.spawn()?;
        live.push(Live { leader: child.id(), is_judge });
        Ok(Self { child, ended: None, is_judge })
    }

    pub fn child(&mut self) -> &mut Child {
        &mut self.child
    }

    /// Whether the program itself has ended; others of its group may live on.
    pub fn has_ended(&mut self) -> bool {
        has_ended(&mut self.child)
    }

    /// Gives the program `patience` to end by itself, then ends it and its group. What it ended
    /// with, or nothing where it had to be ended.
    pub fn end(&mut self, patience: Duration) -> Option<ExitStatus> {
        let start = Instant::now();
        let mut by_itself = self.has_ended();
        while !by_itself && start.elapsed() < patience {
            std::thread::sleep(Duration::from_millis(1));
            by_itself = self.has_ended();
        }
        self.kill();
        self.ended.filter(|_| by_itself)
    }

    fn kill(&mut self) {
        if self.ended.is_some() {
            return;
        }
        Live { leader: self.child.id(), is_judge: self.is_judge && !self.has_ended() }.end();
        let _ = self.child.kill();
        let mut live = LIVE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(live) = live.as_mut() {
            live.retain(|live| live.leader != self.child.id());
        }
        self.ended = self.child.wait().ok();
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        self.kill();
    }
}

/// Ends every group and exits with status 130 on Ctrl-C, and on a request to terminate. From now on
/// [`end_strays`] has something to do.
pub fn end_all_on_ctrl_c() {
    adopt();
    end_groups_on_ctrl_c();
}

/// As [`end_all_on_ctrl_c`], for a process that starts judges alone, which do the adopting.
pub fn end_groups_on_ctrl_c() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    // Without a handler the groups would live on; judging still works.
    ONCE.call_once(|| {
        // The handler runs on a thread. Where none can be started, `ctrlc` would only switch Ctrl-C off.
        if !std::thread::Builder::new().spawn(|| ()).is_ok_and(|thread| thread.join().is_ok()) {
            return;
        }
        #[cfg(any(unix, windows))]
        let _ = ctrlc::set_handler(|| {
            let mut live = LIVE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            live.take().into_iter().flatten().for_each(Live::end);
            end_strays();
            std::process::exit(130);
        });
    });
}

/// Makes this process the parent of what programs leave behind.
#[cfg(target_os = "linux")]
fn adopt() {
    // Where it is refused, strays live on.
    let _ = rustix::process::set_child_subreaper(Some(rustix::process::getpid()));
}

#[cfg(not(target_os = "linux"))]
fn adopt() {}

/// Ends what left its group and outlived its program. For the end of a process that starts nothing else:
/// every child is taken for a stray.
#[cfg(target_os = "linux")]
pub fn end_strays() {
    end_children(|_| true);
}

/// As [`end_strays`], while this process goes on: children in its own session and process group, which it
/// may have started itself, and programs that still run are left alone.
#[cfg(target_os = "linux")]
pub fn end_strays_of_ended_groups() {
    // Held meanwhile, so that what is being started is in the list.
    let live = LIVE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let Some(own) = group_and_session("self") else { return };
    end_children(|child| {
        let id = child.as_raw_nonzero().get();
        let is_live = live.iter().flatten().any(|live| live.leader == id as u32);
        !is_live && group_and_session(&id.to_string()).is_some_and(|its| its != own)
    });
}

/// Asks this process to terminate when its parent ends, however that happens.
#[cfg(target_os = "linux")]
pub fn end_with_parent() {
    // Where it is refused, it ends by its own limits.
    let _ = rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::TERM));
}

/// Elsewhere it ends by its own limits.
#[cfg(not(target_os = "linux"))]
pub fn end_with_parent() {}

/// Ends every process that has this variable in its environment: what a judge has left that was killed.
#[cfg(target_os = "linux")]
pub fn end_marked(variable: &str) {
    use rasterproof_host::{input::read, limits};
    use rustix::process::{Pid, Signal, kill_process};
    // What one of them has started since the last look has the variable too.
    for _ in 0..100 {
        let mut found = false;
        for entry in std::fs::read_dir("/proc").into_iter().flatten().flatten() {
            let number = entry.file_name().to_str().and_then(|name| name.parse().ok());
            let Some(process) = number.and_then(Pid::from_raw) else { continue };
            let environment = read(&entry.path().join("environ"), limits::NOTE_BYTES);
            let environment = environment.unwrap_or_default();
            if environment.split(|byte| *byte == 0).any(|word| word == variable.as_bytes()) {
                found |= kill_process(process, Signal::KILL).is_ok();
            }
        }
        if !found {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Processes are found in `/proc`, which only Linux has: elsewhere they live on.
#[cfg(not(target_os = "linux"))]
pub fn end_marked(_: &str) {}

/// The process group and the session of a process, as `/proc` has them. In a container they are 0 where
/// their leader lives outside; `rustix` takes 0 for no number and panics.
#[cfg(target_os = "linux")]
fn group_and_session(process: &str) -> Option<[i32; 2]> {
    use rasterproof_host::{input::read, limits};
    let path = format!("/proc/{process}/stat");
    let stat = read(std::path::Path::new(&path), limits::NOTE_BYTES).ok()?;
    let stat = String::from_utf8_lossy(&stat);
    // The name stands in brackets and may hold anything: state, parent, group and session follow the last one.
    let mut numbers = stat.rsplit(')').next()?.split_whitespace().skip(2);
    Some([numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?])
}

#[cfg(target_os = "linux")]
fn end_children(is_stray: impl Fn(rustix::process::Pid) -> bool) {
    use rasterproof_host::{input::read_text, limits};
    use rustix::process::{Pid, Signal, WaitOptions, child_subreaper, kill_process, waitpid};
    if !matches!(child_subreaper(), Ok(Some(_))) {
        return;
    }
    // What a stray has started is adopted when the stray ends; one that goes on for ever is left.
    for _ in 0..1000 {
        let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
        let list =
            |task: std::fs::DirEntry| read_text(&task.path().join("children"), limits::NOTE_BYTES);
        let lists = tasks.filter_map(|task| list(task).ok());
        let children = lists.collect::<Vec<_>>().join(" ");
        let pids = children.split_whitespace().filter_map(|word| Pid::from_raw(word.parse().ok()?));
        let strays: Vec<Pid> = pids.filter(|pid| is_stray(*pid)).collect();
        for stray in &strays {
            if kill_process(*stray, Signal::KILL).is_ok() {
                let _ = waitpid(Some(*stray), WaitOptions::empty());
            }
        }
        if strays.is_empty() {
            return;
        }
    }
}

/// Processes are found in `/proc`, which only Linux has: elsewhere they live on.
#[cfg(not(target_os = "linux"))]
pub fn end_strays() {}

/// Processes are found in `/proc`, which only Linux has: elsewhere they live on.
#[cfg(not(target_os = "linux"))]
pub fn end_strays_of_ended_groups() {}

#[cfg(unix)]
fn kill(leader: u32) {
    use rustix::process::{Pid, Signal, kill_process_group};
    if let Some(group) = i32::try_from(leader).ok().and_then(Pid::from_raw) {
        // It fails where nothing is left to kill.
        let _ = kill_process_group(group, Signal::KILL);
    }
}

#[cfg(not(unix))]
fn kill(_: u32) {}

/// Asks a child to terminate, and waits until it has.
#[cfg(unix)]
fn terminate(child: u32) {
    use rustix::process::{Pid, Signal, kill_process};
    let Some(child) = i32::try_from(child).ok().and_then(Pid::from_raw) else { return };
    let start = Instant::now();
    let _ = kill_process(child, Signal::TERM);
    while !has_ended_by_number(child) && start.elapsed() < TIME_TO_END {
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[cfg(not(unix))]
fn terminate(_: u32) {}

/// Looks without reaping: the number of a process that is not reaped is not given to another.
#[cfg(unix)]
fn has_ended(child: &mut Child) -> bool {
    has_ended_by_number(rustix::process::Pid::from_child(child))
}

#[cfg(unix)]
fn has_ended_by_number(child: rustix::process::Pid) -> bool {
    use rustix::process::{WaitId, WaitIdOptions, waitid};
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    matches!(waitid(WaitId::Pid(child), options), Ok(Some(_)) | Err(_))
}

#[cfg(not(unix))]
fn has_ended(child: &mut Child) -> bool {
    !matches!(child.try_wait(), Ok(None))
}
