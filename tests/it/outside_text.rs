//! Text that other people wrote reaches the terminal without characters that change what it shows.

use crate::program::{Folder, PROGRAM};

/// Sets a colour, the title of the window, the direction of writing; ends a line.
const HOSTILE: &str = "\u{1b}[31m\u{1b}]0;t\u{7}\u{202e}\u{9b}2J\u{200b}";

/// Asserts that neither stream holds anything of it; returns both.
fn check(folder: &Folder, words: &[&str]) -> String {
    let output = folder.command(words).output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    for (at, character) in text.char_indices() {
        let is_hidden = rasterproof_host::text::is_hidden(character);
        let near = || text[at..].chars().take(20).collect::<String>();
        assert!(!is_hidden || "\n\t".contains(character), "{words:?}: {:?} in {text}", near());
    }
    text
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn no_hidden_character_reaches_a_terminal() {
    let folder = Folder::new("outside-text");
    std::fs::create_dir(folder.join("snapshots")).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let model = format!("{HOSTILE}.obj");
    let broken = format!("mtllib {HOSTILE}.mtl\nusemtl {HOSTILE}\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    write(&model, &format!("{broken}f 1 2 3\n"));
    write("broken.obj", &format!("{broken}f 1 2 {HOSTILE}\n"));
    write("material.obj", &format!("mtllib material.mtl\nusemtl {HOSTILE}\n{broken}f 1 2 3\n"));
    write("material.mtl", &format!("newmtl {HOSTILE}\nKd 1 1 {HOSTILE}\nmap_Kd {HOSTILE}.png\n"));
    write("answers.txt", &format!("{HOSTILE}\n{HOSTILE}\n"));
    write("object.json", &format!("{{\"{HOSTILE}\": \"{HOSTILE}\"}}"));
    write("course.toml", &format!("language = \"{HOSTILE}\"\n{HOSTILE}"));
    write(&format!("snapshots/{HOSTILE}\n.snap.new"), &format!("---\nsource: {HOSTILE}\n---\nx\n"));
    write(
        "program.sh",
        &format!("read x\nprintf '%s\\n' '{HOSTILE}'\nprintf '%s\\n' '{HOSTILE}' >&2\n"),
    );
    let speaks = "while read x; do case $x in HELLO*) \
                  echo \"RASTERPROOF 1 name=$1 rule=top-left capabilities=coverage\";; \
                  *) echo \"$1\"; echo \"$1\" >&2;; esac; done";
    write("speaks.sh", speaks);
    let runs = [
        "render {h}.obj --size 16x16",
        "render broken.obj --size 16x16",
        "render material.obj --size 16x16",
        "render material.obj --size 16x16 --json",
        "render cube --size 16x16 --plan object.json",
        "render cube --size 16x16 -o {h}.png",
        "render {h}",
        "plan {h}.obj --rounds 1 --size 16x16",
        "plan {h}.obj --rounds 1 --size 16x16 --json",
        "plan {h}",
        "inspect {h}",
        "inspect T2 --plant {h}",
        "inspect T2 -o {h}.png",
        "engine {h}",
        "verify --family {h}",
        "verify --shard {h}",
        "verify {h}",
        "{h}",
        "{h}+",
        "--cases {h}",
        "--cases 5 --report --out {h}",
        "specimens --specimen {h}",
        "specimens --cases 1 --specimen book-ch2 -o {h}.png",
        "review",
        "review {h}",
        "cost --from object.json",
        "cost --from {h}",
        "merge object.json {h}",
        "merge object.json object.json",
        "exhaust lines --reach 1 --checkpoint object.json",
        "exhaust lines --reach 1 -o {h}",
        "quiz 2 --answers answers.txt",
        "quiz {h}",
        "playground --module {h}",
        "course {h}",
        "course",
        "course check -- {h}",
        "judge --baseline object.json -- PROGRAM engine scanline",
        "judge --start-timeout 2 --timeout 2 --cases 3 -- {h}",
        "judge --start-timeout 2 --timeout 2 --cases 3 -- bash program.sh",
        "judge --start-timeout 2 --timeout 2 --cases 3 --family sliver -- bash speaks.sh {h}",
        "judge --start-timeout 2 --timeout 2 --cases 3 --family sliver --json -- bash speaks.sh {h}",
        "judge --start-timeout 2 --timeout 2 --cases 3 --format tap -- bash speaks.sh {h}",
        "judge --start-timeout 2 --timeout 2 --cases 3 --format junit -- bash speaks.sh {h}",
        "judge --league {h}",
        "digest {h}",
    ];
    for words in runs {
        let word = |word: &str| match word {
            "{h}+" => format!("{HOSTILE}\nx"),
            "PROGRAM" => PROGRAM.to_owned(),
            word => word.replace("{h}", HOSTILE),
        };
        let words: Vec<_> = words.split(' ').map(word).collect();
        check(&folder, &words.iter().map(String::as_str).collect::<Vec<_>>());
    }
    // An end of line in a word cannot begin a line of its own.
    let said = check(&folder, &["verify", "--family", "x\nAGREES: all"]);
    assert!(!said.lines().any(|line| line.starts_with("AGREES")), "{said}");
    let said = check(&folder, &["review"]);
    assert!(said.contains("\\u{1b}[31m") && said.contains("\\n.snap: "), "{said}");
}
