-- What a change of the public headers means for the version of the library.
--
--   nothing   the interface is the same
--   minor     hosts built before run as before: something was added
--   major     hosts built before may break

local header = require "header"

local compare = {}

--- Structures without a size. The library lends the first ones by a pointer, one at a time, so they
--- may grow at their end. The others are values, which never change: they lie in arrays and in
--- other structures, or are returned.
compare.LENT = { celspan_fault = true, celspan_glyph = true, celspan_svg_element = true }
compare.VALUES = {}
for name in ([[origin point box matrix paint light light_texture stop rectangle scanline_row
  rostrum_counts exposure span feature variation svg_font svg_changed light_field relight_ground
  stack_light luma sound_passage sound_ducker contour picture_tiles]]):gmatch "%S+" do
  compare.VALUES["celspan_" .. name] = true
end

local function is_sized(struct) return struct.fields[1].name == "struct_size" end

--- Structures of which it is not settled how they grow, as sentences.
function compare.unsettled(face)
  local faults, structs = {}, {}
  local function say(...) faults[#faults + 1] = (...):format(select(2, ...)) end
  for _, struct in ipairs(face.structs) do structs[struct.name] = struct end
  for _, struct in ipairs(face.structs) do
    local name = struct.name
    if not (is_sized(struct) or compare.LENT[name] or compare.VALUES[name]) then
      say("%s has no struct_size, and is no value that never changes", name)
    end
    for _, field in ipairs(struct.fields) do
      local inner = structs[field.type:match "[%w_]+$"]
      if inner and field.stars == "" and not compare.VALUES[inner.name] then
        say("%s.%s lies in a structure, where it cannot grow", name, field.name)
      end
    end
  end
  for _, one in ipairs(face.functions) do
    for const, name in one.arguments:gmatch "(%w*) ?(celspan_[%w_]+) %*[%w_]" do
      if compare.LENT[name] and const ~= "const" then
        say("%s fills a %s, which hosts know in another size", one.name, name)
      end
    end
  end
  return faults
end

--- "struct.field" -> { offset, size }, "struct" -> size, as a C compiler lays the declarations out.
local function layout(text, face)
  local base = os.tmpname()
  local lines = { "#include <stdbool.h>", "#include <stddef.h>", "#include <stdint.h>",
    "#include <stdio.h>", text, "int main(void) {" }
  for _, struct in ipairs(face.structs) do
    lines[#lines + 1] = ('printf("%s 0 %%zu\\n", sizeof(%s));'):format(struct.name, struct.name)
    for _, field in ipairs(struct.fields) do
      lines[#lines + 1] = ('printf("%s.%s %%zu %%zu\\n", offsetof(%s, %s), sizeof(((%s *)0)->%s));')
        :format(struct.name, field.name, struct.name, field.name, struct.name, field.name)
    end
  end
  lines[#lines + 1] = "}\n"
  local file = assert(io.open(base .. ".c", "w"))
  file:write(table.concat(lines, "\n"))
  file:close()
  assert(os.execute(("cc -w -o %s.out %s.c"):format(base, base)))
  local places = {}
  for line in io.popen(base .. ".out"):lines() do
    local name, offset, size = line:match "^(%S+) (%d+) (%d+)$"
    places[name] = { offset = tonumber(offset), size = tonumber(size) }
  end
  for _, ending in ipairs { "", ".c", ".out" } do os.remove(base .. ending) end
  return places
end

local function squeeze(text) return (text:gsub("%s+", " "):gsub("^ ", ""):gsub(" $", "")) end

local function spell(field)
  return squeeze(table.concat({ field.type, field.stars or "", field.sizes or "",
    field.result or "", field.arguments or "" }, " "))
end

local function by_name(list)
  local found = {}
  for _, item in ipairs(list) do found[item.name] = item end
  return found
end

local function compare_functions(old, new, say)
  local known, now = by_name(old), by_name(new)
  for _, one in ipairs(old) do
    local other = now[one.name]
    if not other then
      say("major", one.name .. " is gone")
    elseif squeeze(one.result .. one.arguments) ~= squeeze(other.result .. other.arguments) then
      say("major", one.name .. " takes or returns something else")
    end
  end
  for _, one in ipairs(new) do
    if not known[one.name] then say("minor", one.name .. " is new") end
  end
end

local function compare_enums(old, new, say)
  local values, known = {}, {}
  for _, enum in ipairs(new) do
    for _, one in ipairs(enum.list) do values[one.name] = one.value end
  end
  for _, enum in ipairs(old) do
    for _, one in ipairs(enum.list) do
      known[one.name] = true
      if values[one.name] ~= one.value then say("major", one.name .. " has another value") end
    end
  end
  for name in pairs(values) do
    if not known[name] then say("minor", name .. " is new") end
  end
end

--- A structure with a size may grow: behind all that it had, its padding included.
local function compare_struct(old, new, places, say)
  local name, is_lent = old.name, compare.LENT[old.name]
  local can_grow, had = is_lent or is_sized(old), is_lent and 0 or places.old[old.name].size
  for i, field in ipairs(old.fields) do
    local other = new.fields[i]
    local a, b = places.old[name .. "." .. field.name], places.new[name .. "." .. field.name]
    if not other or other.name ~= field.name or spell(other) ~= spell(field)
      or a.offset ~= b.offset or a.size ~= b.size then
      say("major", ("%s.%s has changed"):format(name, field.name))
    end
  end
  for i = #old.fields + 1, #new.fields do
    local place = places.new[name .. "." .. new.fields[i].name]
    local is_behind = can_grow and place.offset >= had
    say(is_behind and "minor" or "major", ("%s.%s is new%s"):format(name, new.fields[i].name,
      is_behind and "" or can_grow and ", in the padding of what hosts have" or
      ", in a structure that has no struct_size"))
  end
end

local function compare_structs(old, new, places, say)
  local known, now = by_name(old), by_name(new)
  for _, one in ipairs(old) do
    if now[one.name] then
      compare_struct(one, now[one.name], places, say)
    else
      say("major", one.name .. " is gone")
    end
  end
  for _, one in ipairs(new) do
    if not known[one.name] then say("minor", one.name .. " is new") end
  end
end

--- Two texts of declarations: "nothing", "minor" or "major", and the changes.
function compare.texts(before, after)
  local old, new = header.parse(before), header.parse(after)
  local worst, changes = "nothing", {}
  local function say(weight, change)
    if weight == "major" or worst == "nothing" then worst = weight end
    changes[#changes + 1] = ("%s: %s"):format(weight, change)
  end
  local places = { old = layout(before, old), new = layout(after, new) }
  compare_functions(old.functions, new.functions, say)
  compare_functions(old.callbacks, new.callbacks, say)
  compare_enums(old.enums, new.enums, say)
  compare_structs(old.structs, new.structs, places, say)
  table.sort(changes)
  return worst, changes
end

return compare
