--- celspan describe SCRIPT: a film as text, from a survey of all its frames (survey.lua).
local program, request = ...

local STRETCHES_MOST = 8 -- of a part in a line

--- "1-48 0-2 s"
local function span_of(stretch)
  return ("%d-%d %.4g-%.4g s"):format(stretch.first, stretch.last, stretch.from, stretch.to)
end

local function put(format, ...) io.write(format:format(...), "\n") end

--- Names and words come from the script: what could end a line is shown as a space.
local function plain(text) return (text:gsub("[%c\127]", " ")) end

local function place_of(one)
  return one.file and (" (%s:%d)"):format(plain(one.file), one.line) or ""
end

local function moving(one) return one.moves and "moving" or "still" end

local function put_part(part)
  local spans = {}
  for i = 1, math.min(#part.on, STRETCHES_MOST) do spans[i] = span_of(part.on[i]) end
  if #part.on > STRETCHES_MOST then
    spans[#spans + 1] = ("and %d more up to %d"):format(#part.on - STRETCHES_MOST,
      part.on[#part.on].last)
  end
  put("%s %s share %.3g %s name %s%s", part.kind, table.concat(spans, ", "), part.share,
    moving(part), plain(part.name), place_of(part))
end

local function put_text(text)
  put("text %s pixels %.4g contrast %s covered %s share %.3g %s words %s%s", span_of(text),
    text.pixels, text.contrast and ("%.3g"):format(text.contrast) or "unknown",
    text.covered and ("%.3g"):format(text.covered) or "unknown", text.share, moving(text),
    plain(text.words), place_of(text))
end

local function put_all(name, list, more)
  for _, one in ipairs(list) do put("%s %s%s", name, span_of(one), more and more(one) or "") end
end

local function put_facts(facts)
  if facts.title then put("title %s", plain(facts.title)) end
  put("size %dx%d\nfps %.9g\nframes %d-%d\nseconds %.9g\nsound %s", facts.size[1], facts.size[2],
    facts.fps, facts.first, facts.last, facts.seconds, facts.sound and "yes" or "no")
  for _, mark in ipairs(facts.marks.list) do
    put("mark %d %.4g s %s", mark.frame, mark.from, plain(mark.name))
  end
  put_all("shot", facts.shots)
  for _, part in ipairs(facts.parts) do put_part(part) end
  for _, text in ipairs(facts.texts) do put_text(text) end
  put_all("empty", facts.empty)
  put_all("frozen", facts.frozen, function(one) return one.held and " held by a sheet" or "" end)
  put_all("flashes", facts.flashes, function(one) return (" share %.3g"):format(one.share) end)
  put_all("unseen", facts.unseen)
  if facts.more then put "more" end
end

local film = program.film()
local survey = program.part("survey.lua", program, film)
for _, number in ipairs(film:numbers()) do
  film:build(number)
  survey:add(number)
end

local facts, marks = survey:facts(), {}
for i, mark in ipairs(film.marks) do
  marks[i] = { name = mark.name, frame = mark.frame, from = (mark.frame - film.first) / film.fps }
end
facts.title, facts.size, facts.fps, facts.sound = film.title, film.size, film.fps, film.has_sound
facts.first, facts.last = film.first, film.first + film.frames - 1
facts.seconds, facts.marks = film.frames / film.fps, { list = marks }
if request.json then
  for _, name in ipairs { "shots", "parts", "texts", "empty", "frozen", "flashes", "unseen" } do
    facts[name] = { list = facts[name] }
  end
  print(program.json(facts))
else
  put_facts(facts)
end
