//! A search that asks, as a value: it returns what to ask next, and is given the answers. It calls nobody, so whoever answers may be a
//! function, a program behind a pipe, or a page that draws a picture some time later.
//!
//! What a search does is written in sequence, as an `async` function. Where it needs answers it waits for [`Asker::ask`], and it waits
//! for nothing else: the compiler makes the value of the function, and no runtime is needed to go on with it.

use std::cell::RefCell;
use std::future::{Future, poll_fn};
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

/// What a search and whoever answers it share.
struct Mailbox<Q, A> {
    /// Questions that wait for answers.
    questions: Vec<Q>,
    /// The answers to these, once they are given.
    answers: Option<Vec<A>>,
    failing: Vec<Q>,
    /// How many more questions may be asked.
    left: usize,
}

/// By which a search asks.
pub struct Asker<Q, A>(Rc<RefCell<Mailbox<Q, A>>>);

impl<Q: Clone, A> Asker<Q, A> {
    pub(crate) fn new() -> Self {
        let (questions, failing) = (Vec::new(), Vec::new());
        let mailbox = Mailbox { questions, answers: None, failing, left: usize::MAX };
        Self(Rc::new(RefCell::new(mailbox)))
    }

    /// One answer for each question, in order; of the first questions only, where the rest is not answered.
    pub async fn ask(&self, questions: &[Q]) -> Vec<A> {
        if questions.is_empty() {
            return Vec::new();
        }
        self.send(questions);
        poll_fn(|_| self.0.borrow_mut().answers.take().map_or(Poll::Pending, Poll::Ready)).await
    }

    /// Answers that nobody waited for are none.
    fn send(&self, questions: &[Q]) {
        let mut mailbox = self.0.borrow_mut();
        (mailbox.questions, mailbox.answers) = (questions.to_vec(), None);
    }

    /// Questions whose answers are known to be wrong: what goes wrong rarely is learned of beside these.
    #[must_use]
    pub fn failing(&self) -> Vec<Q> {
        self.0.borrow().failing.clone()
    }

    /// As many questions of these as may still be asked: fewer of a slow program.
    #[must_use]
    pub fn at_most(&self, most: usize) -> usize {
        most.min(self.0.borrow().left)
    }
}

/// What a search does next.
pub enum Step<Q, T> {
    /// It waits for the answers to some questions.
    Asks(Vec<Q>),
    /// It has come to its end.
    Found(T),
}

/// A search for a `T` by questions of type `Q` and answers of type `A`.
pub struct Search<'a, Q, A, T> {
    mailbox: Rc<RefCell<Mailbox<Q, A>>>,
    rest: Pin<Box<dyn Future<Output = T> + 'a>>,
}

impl<'a, Q: Clone + 'a, A: 'a, T> Search<'a, Q, A, T> {
    /// Does what a function does, which asks by what it is given.
    pub fn new(find: impl AsyncFnOnce(Asker<Q, A>) -> T + 'a) -> Self {
        let asker = Asker::new();
        let mailbox = Rc::clone(&asker.0);
        Self { mailbox, rest: Box::pin(async move { find(asker).await }) }
    }
}

impl<Q: Clone, A, T> Search<'_, Q, A, T> {
    /// The same, where the answers to some questions are known to be wrong.
    #[must_use]
    pub fn beside(self, failing: Vec<Q>) -> Self {
        self.mailbox.borrow_mut().failing = failing;
        self
    }

    /// Goes on as far as the answers reach. Nothing is to be asked of it after its end.
    pub fn step(&mut self) -> Step<Q, T> {
        match self.rest.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(found) => Step::Found(found),
            Poll::Pending => Step::Asks(self.mailbox.borrow().questions.clone()),
        }
    }

    /// Takes the answers to the questions that wait, in order; fewer where the rest is not answered.
    pub fn answer(&mut self, answers: Vec<A>) {
        self.mailbox.borrow_mut().answers = Some(answers);
    }

    /// Says how many more questions may be asked.
    pub fn allow(&mut self, left: usize) {
        self.mailbox.borrow_mut().left = left;
    }

    /// What it comes to when somebody answers at once.
    pub fn answered_by(mut self, mut answer: impl FnMut(&[Q]) -> Vec<A>) -> T {
        loop {
            match self.step() {
                Step::Asks(questions) => self.answer(answer(&questions)),
                Step::Found(found) => return found,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number that is looked for between two, by questions of whether it is below others.
    async fn halved(asker: &Asker<u32, bool>, mut low: u32, mut high: u32) -> u32 {
        while high - low > 1 {
            let middle = low.midpoint(high);
            match asker.ask(&[middle]).await.first() {
                Some(true) => high = middle,
                Some(false) => low = middle,
                None => break,
            }
        }
        low
    }

    fn search(high: u32) -> Search<'static, u32, bool, u32> {
        Search::new(async move |asker: Asker<u32, bool>| halved(&asker, 0, high).await)
    }

    #[test]
    fn a_search_is_a_value() {
        assert_eq!(search(1000).answered_by(|asked| vec![617 < asked[0]]), 617);
        // Two of them take turns, and one waits meanwhile.
        let mut both = [search(1000), search(7)];
        let mut found = [None; 2];
        for turn in 0..40 {
            let i = turn % 2;
            if found[i].is_some() {
                continue;
            }
            match both[i].step() {
                Step::Asks(asked) => both[i].answer(vec![[617, 3][i] < asked[0]]),
                Step::Found(number) => found[i] = Some(number),
            }
        }
        assert_eq!(found, [Some(617), Some(3)]);
        // Without answers it goes on waiting for the same, and comes to an end where there are none.
        let mut search = search(9);
        for _ in 0..3 {
            assert!(matches!(search.step(), Step::Asks(asked) if asked == [4]));
        }
        search.answer(Vec::new());
        assert!(matches!(search.step(), Step::Found(0)));
        // What is given before anything is asked is no answer.
        let mut early = self::search(9);
        early.answer(vec![true]);
        assert!(matches!(early.step(), Step::Asks(asked) if asked == [4]));
        assert!(matches!(early.step(), Step::Asks(asked) if asked == [4]));
    }

    /// What is not asked is not waited for; what is known beforehand is known on the way.
    #[test]
    fn a_search_hears_what_is_known_of_who_answers() {
        let search = Search::new(async |asker: Asker<u8, ()>| {
            let none = asker.ask(&[]).await.len();
            let before = asker.at_most(7);
            asker.ask(&asker.failing()).await;
            (none, before, asker.at_most(7))
        });
        let mut search = search.beside(vec![1, 2]);
        assert!(matches!(search.step(), Step::Asks(asked) if asked == [1, 2]));
        search.allow(5);
        search.answer(Vec::new());
        assert!(matches!(search.step(), Step::Found((0, 7, 5))));
    }
}
