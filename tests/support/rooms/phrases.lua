--- Phrases that make English hard to read, and what to write instead; add to the list freely. A
--- reader from another country should understand every sentence at first reading.
---
--- Each phrase is a list of words; `a|b` accepts either word, and letter case does not matter.
---
--- not_before   no match when one of these words follows
--- not_after    no match when one of these words precedes
--- at_end       a match only where no other word of the sentence follows at once
--- not_near     no match when one of these words is among the next NEAR words
local phrases = { NEAR = 12 }

local PLACES = "in|of|on|at|before|behind|there|inside|outside|above|below|under|beyond|between"
  .. "|around|within|beside"

phrases.list = {
  { say = "report, say, print, describe, specify or define",
    not_after = "you", not_before = "from|to", not_near = "apart",
    "told" },
  { say = "report, show, determine or return; for 'tells whether', write what is returned",
    not_before = "you|us|me|from", not_near = "apart",
    "tells", "tell|telling of|nothing|little|no|what|how|its|their" },
  { say = "name the noun: is not a..., is invalid, is missing, does not exist",
    not_after = "there",
    "is|are|was|were|be|been none", "as none" },
  { say = "use a noun: the contents, the background, the part above", not_before = "front",
    "what is|are|was|were " .. PLACES },
  { say = "is, appears, is placed, means", not_before = "for|in|out|alone|still|up",
    "stand|stands|stood|standing" },
  { say = "except, apart from, were it not for", "but for" },
  { say = "compared with, checked against, clamped to, must keep", "hold|holds|held|holding to" },
  { say = "again", "anew" },
  { say = "at random", "by lot" },
  { say = "name the damage: crashes, leaks, changes the result, is harmful",
    "do|does|did|done|doing harm" },
  { say = "allow, accept, ignore", "let|lets|letting pass|past" },
  { say = "name them: those that are", "such as is|are|was|were|have|has|can|do|does|cannot" },
  { say = "name the rest, or write 'similar'", "the like" },
  { say = "also, in addition, apart from", "besides" },
  { say = "must be, should be, will be", not_before = "expected",
    "is|are|was|were to be|have|go" },
  { say = "give the number, or 'that many', 'as many', 'a given number of'", not_near = "that|as",
    "so many|much|few" },
  { say = "continue, resume",
    not_before = "the|a|an|top|to|each|its|their|this|that|every|one|them|it|foot|stage|paper",
    "go|goes|going|went|gone on" },
  { say = "fix", "mend|mends|mended|mending" },
  { say = "treat as, mistake for, allocate", not_before = "ever|granted|long",
    "take|takes|taken|taking for" },
  { say = "the result is, it amounts to", at_end = true, "it|they|each|this comes|come|came to" },
  { say = "pass on, forward, inherit", "hand|hands|handed|handing on" },
  { say = "existing, all, which exist; or leave it out", at_end = true,
    "that there is|are|was|were" },
  { say = "is available, is missing", "can|could|cannot be had" },
  { say = "which parts of... are there", "what is there of" },
  { say = "still, nevertheless", "all the same" },
  { say = "rarely", "seldom" },
  { say = "name the noun: the space around it, the hashes of the rostrum",
    "that|those of what|which", "that of the one" },
  { say = "say both cases: `one` where the mask is set, and `other` elsewhere", "else the other" },
  { say = "at the edge, along the border, at that distance", "on the rim" },
  { say = "the same for", "the same of" },
  { say = "name the part: the part of it that, which of them", "what of it|them|its|their|a|what" },
  { say = "otherwise the ... of", "else that|those of" },
  { say = "name the noun: the contents, the visible items, the colours",
    not_before = "itself|up", "what shows" },
  { say = "name the noun: the layers that transmit, the light that passes", "what lets|let" },
  { say = "two sentences, or 'whose': the tiles that are live around it are live",
    "of which those are|were" },
}

--- Places where a phrase is right; `text` is part of the sentence around it.
phrases.exceptions = {
  { place = "scripts/film/", text = "stand", why = "people and houses stand on the ground" },
  { place = "scripts/film/", text = "stands", why = "people and houses stand on the ground" },
  { place = "scripts/paper/figure09.lua", text = "the mask for what is behind",
    why = "the words are drawn in the figure, which is compared bit for bit" },
}

return phrases
