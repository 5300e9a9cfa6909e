//! The page of the eighteen steps: its answers are those of the engines, its formulas with numbers are right, and each
//! section is short.

use rasterproof_teaching::course::{self, STEPS};

use crate::pages::page;
use crate::protocol::ask;

/// A reader of sums and products of numbers, with parentheses.
struct Formula<'a>(&'a str);

impl Formula<'_> {
    fn take(&mut self, signs: &str) -> Option<char> {
        self.0 = self.0.trim_start();
        let sign = self.0.chars().next().filter(|c| signs.contains(*c))?;
        self.0 = &self.0[1..];
        Some(sign)
    }

    fn sum(&mut self) -> f64 {
        let mut sum = self.product();
        while let Some(sign) = self.take("+-") {
            let next = self.product();
            sum += if sign == '+' { next } else { -next };
        }
        sum
    }

    fn product(&mut self) -> f64 {
        let mut product = self.factor();
        while let Some(sign) = self.take("*/") {
            let next = self.factor();
            product *= if sign == '*' { next } else { 1.0 / next };
        }
        product
    }

    fn factor(&mut self) -> f64 {
        if self.take("-").is_some() {
            return -self.factor();
        }
        if self.take("(").is_some() {
            let sum = self.sum();
            self.take(")").expect("a parenthesis is closed");
            return sum;
        }
        let end = self.0.find(|c: char| !(c.is_ascii_digit() || c == '.'));
        let (number, rest) = self.0.split_at(end.unwrap_or(self.0.len()));
        self.0 = rest;
        number.parse().unwrap_or_else(|_| panic!("'{number}' before '{rest}' is no number"))
    }
}

/// The formulas in code that end in a number, with what is wrong about them; and how many there are.
fn wrong_formulas(text: &str) -> (usize, Vec<String>) {
    let is_formula = |code: &&str| {
        code.contains(" = ") && !code.contains(|c: char| c.is_alphabetic() || c == '\n')
    };
    let formulas: Vec<_> = text.split('`').skip(1).step_by(2).filter(is_formula).collect();
    let is_wrong = |code: &&&str| {
        let (left, right) = code.rsplit_once(" = ").expect("it has one");
        let mut formula = Formula(left);
        let (value, stated) = (formula.sum(), right.parse::<f64>().expect(right));
        !formula.0.trim().is_empty() || (value - stated).abs() > 1e-12
    };
    (formulas.len(), formulas.iter().filter(is_wrong).map(|code| (*code).to_owned()).collect())
}

/// The requests whose answers on the page are not those of an engine; and how many there are.
fn wrong_answers(text: &str) -> (usize, Vec<String>) {
    let lines = |sign: &str| -> Vec<&str> {
        text.lines().filter_map(|line| line.strip_prefix(sign)).collect()
    };
    let (requests, answers) = (lines("> "), lines("< "));
    assert_eq!(requests.len(), answers.len());
    let mut wrong = Vec::new();
    let asked = [("bresenham", "L"), ("oracle", "Q"), ("edge-function", "TISDN")];
    for (engine, verbs) in asked {
        let pairs = requests.iter().zip(&answers);
        let (requests, printed): (Vec<_>, Vec<_>) =
            pairs.filter(|(request, _)| verbs.contains(&request[..1])).unzip();
        let requests: Vec<&str> = requests.into_iter().copied().collect();
        let said = ask(engine, (requests.join("\n") + "\n").as_bytes());
        let differs = |((_, printed), said): &((&&str, &&&str), &String)| said != **printed;
        let pairs = requests.iter().zip(&printed).zip(&said).filter(differs);
        wrong.extend(pairs.map(|((request, _), said)| format!("{request}: {said}")));
    }
    (requests.len(), wrong)
}

#[test]
fn step_pages_are_what_the_engines_say() {
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "steps");
        let (requests, wrong) = wrong_answers(&text);
        assert!(requests >= 38 && wrong.is_empty(), "{folder}: {requests} {wrong:?}");
        let (formulas, wrong) = wrong_formulas(&text);
        assert!(formulas >= 38 && wrong.is_empty(), "{folder}: {formulas} {wrong:?}");
    }
    // A digit changed is found.
    let text = page("docs", "steps");
    let changed = text.replace("< P 1 1 2 1", "< P 1 1 1 2").replace("= 5.5`", "= 5.25`");
    assert_eq!((wrong_answers(&changed).1.len(), wrong_formulas(&changed).1.len()), (1, 1));
}

/// Every step has a section under its title, of at most 400 words, with the parts that a student needs.
#[test]
fn steps_are_short() {
    let text = page("docs", "steps");
    let sections: Vec<_> = text.split("\n## ").skip(1).collect();
    for (step, section) in STEPS.iter().zip(sections) {
        let number = course::number(step);
        let heading = format!("Step {number}: {}\n", step.title);
        assert!(section.starts_with(&heading), "{heading}{section}");
        let words = section.split_whitespace().count();
        assert!(words <= 400, "step {number} has {words} words");
        for part in
            ["**Goal.**", "**The idea.**", "**Example.**", "**Common mistakes.**", "**Check.**"]
        {
            assert!(section.contains(part), "step {number} lacks {part}");
        }
    }
}

/// The table of the course has each step by its number and name, and nothing else.
#[test]
fn steps_are_in_the_table_of_the_course() {
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "course");
        let listed = text.lines().filter_map(|line| {
            let cells: Vec<_> = line.split('|').map(str::trim).collect();
            let number = cells.get(1)?.strip_prefix('[')?.split(']').next()?;
            (cells.len() == 5).then(|| (number.to_owned(), cells[2].trim_matches('`').to_owned()))
        });
        let listed: Vec<_> = listed.collect();
        let steps: Vec<_> =
            STEPS.iter().map(|step| (course::number(step), step.name.clone())).collect();
        assert_eq!(listed, steps, "{folder}");
    }
}
