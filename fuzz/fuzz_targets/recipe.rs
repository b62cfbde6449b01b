//! Recipes: read, checked, written and read again as the command does.
#![no_main]
use gridshell::recipe::Recipe;

libfuzzer_sys::fuzz_target!(|text: &str| {
    let Ok(recipe) = toml::from_str::<Recipe>(text) else { return };
    if recipe.validate().is_err() {
        return;
    }
    let written = toml::to_string(&recipe).expect("a recipe that holds can be written");
    let again: Recipe = toml::from_str(&written).expect("what was written can be read");
    assert!(again.validate().is_ok(), "{written}");
});
