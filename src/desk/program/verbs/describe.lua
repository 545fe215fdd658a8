--- celspan describe SCRIPT: a film as text, from a survey of all its frames (survey.lua).
local program, request = ...

local STRETCHES_MOST = 8 -- more stretches of a part are not listed on its line

local facts = program.part("facts.lua", program, request)

--- "1-48 0-2 s"
local function span_of(stretch)
  return ("%d-%d %.4g-%.4g s"):format(stretch.first, stretch.last, stretch.from, stretch.to)
end

local function place_of(one) return one.file and (" (%s:%d)"):format(one.file, one.line) or "" end

local function moving(one) return one.moves and "moving" or "still" end

--- A number; or the text for a missing measurement.
local function measured(number) return number and ("%.3g"):format(number) or "unknown" end

local function put_part(part)
  local spans = {}
  for i = 1, math.min(#part.on, STRETCHES_MOST) do spans[i] = span_of(part.on[i]) end
  if #part.on > STRETCHES_MOST then
    spans[#spans + 1] = ("and %d more up to %d"):format(#part.on - STRETCHES_MOST,
      part.on[#part.on].last)
  end
  facts:item("parts", part, "%s %s share %.3g %s name %s%s", part.kind, table.concat(spans, ", "),
    part.share, moving(part), part.name, place_of(part))
end

local function put_text(text)
  facts:item("texts", text, "text %s pixels %.4g contrast %s covered %s share %.3g %s words %s%s",
    span_of(text), text.pixels, measured(text.contrast), measured(text.covered), text.share,
    moving(text), text.words, place_of(text))
end

local function put_film(script)
  if script.title then facts:add("title", script.title) end
  facts:add("size", script.size)
  facts:add("fps", script.fps)
  facts:set("first", script.first)
  facts:set("last", script.first + script.frames - 1)
  facts:line("frames %d-%d", script.first, script.first + script.frames - 1)
  facts:add("seconds", script.frames / script.fps)
  facts:set("sound", script.has_sound)
  facts:line("sound %s", script.has_sound and "yes" or "no")
  for _, mark in ipairs(script.marks) do
    local from = (mark.frame - script.first) / script.fps
    facts:item("marks", { name = mark.name, frame = mark.frame, from = from }, "mark %d %.4g s %s",
      mark.frame, from, mark.name)
  end
end

--- Writes stretches, each on a line that ends with more(stretch).
local function put_all(list, name, stretches, more)
  for _, one in ipairs(stretches) do
    facts:item(list, one, "%s %s%s", name, span_of(one), more and more(one) or "")
  end
end

local function put_survey(found)
  put_all("shots", "shot", found.shots)
  for _, part in ipairs(found.parts) do put_part(part) end
  for _, text in ipairs(found.texts) do put_text(text) end
  put_all("empty", "empty", found.empty)
  put_all("frozen", "frozen", found.frozen,
    function(one) return one.held and " held by a sheet" or "" end)
  put_all("flashes", "flashes", found.flashes,
    function(one) return (" share %.3g"):format(one.share) end)
  put_all("unseen", "unseen", found.unseen)
  if found.more then facts:add("more", true) end
end

local script = program.script()
local survey = program.part("survey.lua", program, script)
local numbers, done = script:numbers(), 0
while done < #numbers and not program.is_stopped() do
  program.until_stopped(function()
    script:build(numbers[done + 1])
    survey:add(numbers[done + 1])
    done = done + 1
  end)
end

facts:lists("marks", "shots", "parts", "texts", "empty", "frozen", "flashes", "unseen")
put_film(script)
put_survey(survey:facts())
facts:finish()
if done < #numbers then program.note("stopped after %d of %d frames", done, #numbers) end
