//! One program for the tests that need more than one room of the house.

mod exact;
