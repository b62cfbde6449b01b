//! Letters with accents, as a letter and a mark.

/// A mark above a letter or below it.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Accent {
    Grave,
    Acute,
    Circumflex,
    Tilde,
    Diaeresis,
    Ring,
    Caron,
    Macron,
    Breve,
    Dot,
    DoubleAcute,
    Cedilla,
    Ogonek,
}

use Accent::{
    Acute, Breve, Caron, Cedilla, Circumflex, Diaeresis, Dot, DoubleAcute, Grave, Macron, Ogonek,
    Ring, Tilde,
};

/// Letters with accents, and below them the same without.
#[rustfmt::skip]
const ACCENTED: [(Accent, &str, &str); 13] = [
    (Grave, "àèìòùÀÈÌÒÙ",
            "aeıouAEIOU"),
    (Acute, "áéíóúýćńśźĺŕÁÉÍÓÚÝĆŃŚŹĹŔάέήίόύώΆΈΉΊΌΎΏ",
            "aeıouycnszlrAEIOUYCNSZLRαεηιουωΑΕΗΙΟΥΩ"),
    (Circumflex, "âêîôûŵŷĉĝĥŝÂÊÎÔÛŴŶĈĜĤŜ",
                 "aeıouwycghsAEIOUWYCGHS"),
    (Tilde, "ãñõĩũÃÑÕĨŨ",
            "anoıuANOIU"),
    (Diaeresis, "äëïöüÿÄËÏÖÜŸϊϋΪΫ",
                "aeıouyAEIOUYιυΙΥ"),
    (Ring, "åůÅŮ",
           "auAU"),
    (Caron, "čďěǧňřšťžČĎĚǦŇŘŠŤŽ",
            "cdegnrstzCDEGNRSTZ"),
    (Macron, "āēīōūĀĒĪŌŪ",
             "aeıouAEIOU"),
    (Breve, "ăĕğĭŏŭĂĔĞĬŎŬ",
            "aegıouAEGIOU"),
    (Dot, "ċėġżĊĖĠİŻ",
          "cegzCEGIZ"),
    (DoubleAcute, "őűŐŰ",
                  "ouOU"),
    (Cedilla, "çşţșțķļņÇŞŢȘȚĶĻŅ",
              "cststklnCSTSTKLN"),
    (Ogonek, "ąęįųĄĘĮŲ",
             "aeiuAEIU"),
];

/// A letter with an accent as both.
pub(super) fn parted(c: char) -> Option<(char, Accent)> {
    ACCENTED.iter().find_map(|(accent, letters, bases)| {
        let k = letters.chars().position(|l| l == c)?;
        Some((bases.chars().nth(k)?, *accent))
    })
}

impl Accent {
    /// On the raster of letters, about x 2, above a small letter.
    pub fn strokes(self) -> &'static str {
        match self {
            Grave => "1c 3a",
            Acute => "3c 1a",
            Circumflex => "0a 2c 4a",
            Tilde => "0a 1b 3a 4b",
            Diaeresis => "1b 1c;3b 3c",
            Ring => "1b 2a 3b 2c 1b",
            Caron => "0c 2a 4c",
            Macron => "0b 4b",
            Breve => "0c 1a 3a 4c",
            Dot => "2b 2c",
            DoubleAcute => "1a 2c;3a 4c",
            Cedilla => "23 22 31 20 10",
            Ogonek => "33 22 30 40",
        }
    }

    /// Where a point of the mark is, on a letter with this middle and this top.
    pub fn place(self, [x, y]: [f64; 2], middle: f64, top: f64) -> [f64; 2] {
        /// The top of small letters.
        const SMALL: f64 = 9.0;
        let up = if matches!(self, Cedilla | Ogonek) { 0.0 } else { top - SMALL };
        [x - 2.0 + middle, y + up]
    }
}

#[cfg(test)]
mod tests {
    use super::ACCENTED;

    #[test]
    fn every_accented_letter_has_one_without() {
        for (_, letters, bases) in ACCENTED {
            assert_eq!(letters.chars().count(), bases.chars().count(), "{letters}");
        }
    }
}
