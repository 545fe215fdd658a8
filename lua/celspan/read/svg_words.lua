--- Numbers, words and lists in the attributes and styles of drawings.
local words = {}

local MOST = 1e12 -- what the core takes as a number

--- The number at a place of a text, and the place behind it; nil: there is none.
function words.number(text, at)
  local behind = text:match("^[+-]?%d+%.?%d*()", at) or text:match("^[+-]?%.%d+()", at)
  if not behind then return nil end
  behind = text:match("^[eE][+-]?%d+()", behind) or behind
  local value = tonumber(text:sub(at, behind - 1)) + 0.0
  if value < -MOST or value > MOST then return nil end
  return value, behind
end

--- The value of the word at a place of a text, capital or small, and the place behind it; nil: the
--- word has none.
function words.choice(text, at, values)
  local word, behind = text:match("^([%a-]+)()", at)
  local value = word and values[word:lower()]
  if value == nil then return nil end
  return value, behind
end

function words.skip_space(text, at) return text:match("^%s*()", at) end

function words.is_blank(text, at) return not text:find("%S", at) end

--- A text is a word, capital or small, between blanks. word: a pattern.
function words.is(text, word)
  return text ~= nil and text:lower():find("^%s*" .. word .. "%s*$") ~= nil
end

--- The parts between semicolons, without the blanks before them; blanks behind the last semicolon
--- are no part.
function words.parts(text)
  local list = {}
  for part in text:gmatch "%s*([^;]*);?" do list[#list + 1] = part end
  if list[#list] == "" and not text:find ";$" then list[#list] = nil end
  return list
end

--- `count` numbers, which begin at a place and have blanks or commas between them, and the place
--- behind them; nil: the text has others.
function words.numbers(text, at, count)
  local list = {}
  for i = 1, count do
    local value
    value, at = words.number(text, text:match("^%s*,?%s*()", at))
    if not value then return nil end
    list[i] = value
  end
  return list, at
end

--- A text that is the same for equal lists of texts, which may be nil.
function words.key(...)
  return ("%s\0"):rep(select("#", ...)):format(...)
end

return words
