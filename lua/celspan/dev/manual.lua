--- The manual of the Lua interface: the annotations for editors, celspan.d.lua, and the pages
--- of `celspan help lua`. The fields of nouns come from their rows in C (src/kit/lua/nouns), the
--- rest from celspan.annotations and from the annotations in the modules. One file, because
--- annotations and pages show the same rows.
local native = require "celspan.native"

local manual = {}

--- The modules for scripts, in the order of the reference.
manual.MODULES = {
  "ease", "keys", "motion", "multiplane", "shutter", "lips", "sheet", "svg", "trace", "track",
  "relight", "ink", "layers", "oca", "json", "csv", "captions", "cut", "sound", "spec", "puppet",
  "particles", "colour", "chart", "typewriter", "lottie",
}
local WIDTH = 100

--- Adds a text in lines of at most WIDTH characters; those after the first begin with `indent`.
local function add_wrapped(page, first, text, indent)
  local line = first
  for word in text:gmatch "%S+" do
    if #line + 1 + #word > WIDTH and line ~= first then
      page[#page + 1] = line
      line = indent
    end
    line = line:find "%S$" and line ~= indent and line .. " " .. word or line .. word
  end
  page[#page + 1] = line
end

-- ---------------------------------------------------------------- annotations

local function number_text(number)
  return (("%.7g"):format(number):gsub("e%+0*", "e"))
end

--- "0 to 1", "0 or more", "more than 0", or nil.
local function range_text(field)
  local most = field.most and number_text(field.most)
  if field.above then
    return "more than " .. number_text(field.above) .. (most and ", at most " .. most or "")
  elseif field.least then
    return number_text(field.least) .. (most and " to " .. most or " or more")
  end
end

local function default_text(field)
  if not field.preset then return field.fallback and "default " .. field.fallback end
  return (tonumber(field.preset) and "default %s" or 'default "%s"'):format(field.preset)
end

--- The facts about a field: the places of its numbers, its sentence, range and default, as far as
--- they exist.
local function comment_of(field)
  local parts = {}
  local function add(part)
    if part and #parts > 0 then part = part:gsub("^%u%f[%l ]", string.lower) end
    parts[#parts + 1] = part
  end
  add(field.type ~= "celspan.point" and field.shape and field.shape:match "%b{}" or nil)
  add(field.about)
  add(range_text(field))
  add(default_text(field))
  return #parts > 0 and " " .. table.concat(parts, "; "):gsub("^default", "Default") or ""
end

local function add_class(lines, noun, name)
  lines[#lines + 1] = "---@class " .. name
  if noun.item then
    local about = noun.items and " " .. noun.items or ""
    lines[#lines + 1] = "---@field [integer] " .. noun.item .. about
  end
  for _, field in ipairs(noun) do
    lines[#lines + 1] = ("---@field %s%s %s%s"):format(field.name, field.is_required and "" or "?",
      field.type, comment_of(field))
  end
end

--- The class of the values of a noun, in which fields with a default are always present.
local function add_value_class(lines, noun, parent)
  local parents = (parent and parent .. ", " or "") .. "celspan." .. noun.name .. ".fields"
  lines[#lines + 1] = ("\n---@class celspan.%s: %s"):format(noun.name, parents)
  for _, field in ipairs(noun) do
    if field.read or field.preset then
      lines[#lines + 1] = ("---@field %s %s"):format(field.name, field.read or field.type)
    end
  end
end

--- The annotations of a noun; they replace its line in celspan.annotations.
local function expand(noun, parent, has_methods, has_constructor)
  local lines = {}
  if noun.table then
    if noun.about then add_wrapped(lines, "--- ", noun.about, "--- ") end
    add_class(lines, noun, noun.table)
    return table.concat(lines, "\n")
  end
  add_class(lines, noun, ("celspan.%s.fields"):format(noun.name))
  add_value_class(lines, noun, parent)
  if has_methods then lines[#lines + 1] = ("local %s = {}"):format(noun.name) end
  if has_constructor then
    lines[#lines + 1] = ""
    add_wrapped(lines, "--- ", noun.about, "--- ")
    lines[#lines + 1] = ("---@param fields celspan.%s.fields\n---@return celspan.%s\n"
      .. "function celspan.%s(fields) end"):format(noun.name, noun.name, noun.name)
  end
  return table.concat(lines, "\n")
end

--- The annotations of the function celspan.`name`, which are above its text in a module.
local function from_module(name, module, own)
  local text = native.source(module)
  local at, _, arguments = text:find(("\nfunction %s%%.%s(%%b())"):format(module, own))
  local above = text:sub(1, at):match ".*\n\n(.*)$"
  return ("%sfunction celspan.%s%s end\n"):format(above, name, arguments)
end

--- Lines that give the globals of scripts their types.
local function globals()
  local lines, module_of = native.names()
  for i, name in ipairs(lines) do
    lines[i] = name .. " = " .. (module_of[name] and ("require %q"):format(module_of[name])
      or "celspan." .. name)
  end
  return table.concat(lines, "\n")
end

--- The text of celspan.d.lua.
function manual.annotations()
  local celspan, nouns, by_line = require "celspan", native.nouns(), {}
  for _, noun in pairs(nouns) do
    by_line[noun.table and noun.table:gsub("^celspan%.", "") or noun.name] = noun
  end
  local text = require "celspan.annotations"
  text = text:gsub("%-%-%-@written ([%w_]+): ([%w_]+)%.([%w_]+)", from_module)
  text = text:gsub("\n\n\n", "\n\n"):gsub("%-%-%-@own (%S+)\n(.-)function ",
    "---@generic T: %1\n---@param self T\n%2---@return T\nfunction ")
  text = text:gsub("%-%-%-@noun ([%w_.]+):? ?([%w_.]*)", function(name, parent)
    local noun = assert(by_line[name], name)
    local has_methods = text:find("function " .. name .. ":", 1, true)
    return expand(noun, parent ~= "" and parent or nil, has_methods, rawget(celspan, name))
  end)
  return (text:gsub("%-%-%-@globals", globals()))
end

-- ---------------------------------------------------------------- reading annotations

--- The type at the beginning of a text, and the comment after it: a type ends at a space outside of
--- brackets and quotes that does not follow a comma or a colon.
local function split_type(text)
  local plain, rest = text:match "^([%w_.|?]+) (.*)$" -- most are
  if plain then return plain, rest end
  local depth, at, quoted = 0, 1, false
  while at <= #text do
    local sign = text:sub(at, at)
    if sign:find "[%(%[{<]" then depth = depth + 1 end
    if sign:find "[%)%]}>]" then depth = depth - 1 end
    if sign == "\"" then quoted = not quoted end
    local is_inside = quoted or depth > 0 or text:sub(at - 1, at - 1):find "[,:]"
    if sign == " " and not is_inside then break end
    at = at + 1
  end
  return text:sub(1, at - 1), text:sub(at + 1)
end

--- Adds a line to a block.
local function read_line(block, line)
  local tag, rest = line:match "^%-%-%-@(%l+) (.*)$"
  if not tag then
    table.insert(block.about, line:match "^%-%-%-? ?(.*)$")
  elseif tag == "class" then
    block.class, block.parents = rest:match "^([%w_.]+):? ?(.*)$"
  elseif tag == "field" or tag == "param" then
    local name, mark, written = rest:match "^(%S-)(%??) (.*)$"
    local type_of, comment = split_type(written)
    table.insert(tag == "field" and block.fields or block.params,
      { name = name, is_optional = mark == "?", type = type_of, comment = comment })
  elseif tag == "return" then
    table.insert(block.returns, rest)
  elseif tag == "overload" then
    block.overload = rest
  elseif tag == "alias" then
    local name, meaning = rest:match "^([%w_.]+) (.*)$"
    local type_of, comment = split_type(meaning)
    block.name, block.fields[1] = name, { name = "is", type = type_of, comment = comment }
  end
end

--- Ends a block. line: the line after it, a function or a variable, which gives the block its name.
local function close_block(block, line, owners)
  local owner, sign, name = line:match "^function ([%w_]+)([.:])([%w_]+)%("
  local variable = line:match "^local ([%w_]+) ="
  if block.class and variable then owners[variable], owners.methods = block.class, block.class end
  if owner and owners[owner] then
    block.owner, block.short, block.is_function = owners[owner], name, true
    block.is_method = sign == ":" and (owners[owner]:match "[%w_]+$" .. sign .. name)
    block.name = owners[owner] .. sign .. name
  end
  block.name = block.name or block.class
end

--- The blocks of annotations in a text: name, about (lines), params, fields and returns. The first
--- block describes the whole text. owners: the names of its variables, { keys = "celspan.keys" }.
function manual.read(text, owners)
  local blocks, block = {}, nil
  for line in (text .. "\n"):gmatch "(.-)\n" do
    local is_alias = block and block.name and line:find "^%-%-%-@alias"
    local is_part = line:find "^%-%-%-" or block and line:find "^%-%-"
    if block and (is_alias or not is_part) then
      close_block(block, line, owners)
      if block.name or #blocks == 0 then blocks[#blocks + 1] = block end
      block = nil
    end
    if is_part then
      block = block or { about = {}, params = {}, fields = {}, returns = {} }
      read_line(block, line)
    end
  end
  return blocks
end

local cached

--- The text of a module, with those of the private modules that it loads when they are used.
local function whole_source(name)
  local text = native.source(name)
  for part in text:gmatch('= "(' .. name .. '_[%w_]+)"') do
    text = text .. "\n" .. native.source(part)
  end
  return text
end

--- All blocks: those of celspan as a list, and those of each module in its field `modules`:
--- { [1] = block, ..., modules = { keys = {...} } }.
local function blocks_of_all()
  if cached then return cached end
  cached = manual.read(manual.annotations(), { celspan = "celspan" })
  cached.modules = {}
  for _, name in ipairs(manual.MODULES) do
    cached.modules[name] = manual.read(whole_source(name), { [name] = "celspan." .. name })
  end
  return cached
end

--- The first result of functions and methods, by name ("celspan.svg.read", "celspan.object:blur"),
--- and for each class the class that it extends.
---@return table<string, string> calls
---@return table<string, string> parents
function manual.types()
  local calls, parents = {}, {}
  local function add(blocks)
    for _, block in ipairs(blocks) do
      local class = block.class or ""
      parents[class] = (block.parents or ""):match "^[%w_.]+"
      calls[class] = (block.overload or ""):match "%): ([%w_.]+)$"
      if block.is_function then calls[block.name] = (block.returns[1] or ""):match "^[%w_.]+" end
    end
  end
  local all = blocks_of_all()
  add(all)
  for _, name in ipairs(manual.MODULES) do add(all.modules[name]) end
  return calls, parents
end

-- ---------------------------------------------------------------- pages

local function plain(text) return (text:gsub("celspan%.", "")) end

--- Adds a row for each item: name, type, comment.
local function add_rows(page, rows)
  local width = 0
  for _, row in ipairs(rows) do width = math.max(width, #row[1]) end
  for _, row in ipairs(rows) do
    add_wrapped(page, ("  %-" .. width .. "s  "):format(row[1]), row[2], (" "):rep(width + 4))
  end
end

local function row_of(item)
  local name = item.name == "[integer]" and "{...}" or item.name
  return { name .. (item.is_optional and "?" or ""),
           plain(item.type) .. (item.comment ~= "" and ": " .. item.comment or "") }
end

local function find_class(name)
  local all = blocks_of_all()
  local module = all.modules[name:match "^celspan%.(%l+)"]
  for _, blocks in ipairs { module or {}, all } do
    for _, block in ipairs(blocks) do
      if block.class == name then return block end
    end
  end
end

--- The rows of a class and of the classes that it extends.
local function class_rows(class, rows)
  for parent in (class.parents or ""):gmatch "[%w_.]+" do
    local found = find_class(parent)
    if found then class_rows(found, rows) end
  end
  for _, field in ipairs(class.fields) do rows[#rows + 1] = row_of(field) end
  return rows
end

--- Whether a type is a table that functions take.
local function is_given(name)
  return name:find "%.fields$" or name:find "%.options$" or name:find "%.style$"
end

local function name_of(param) return param.name .. (param.is_optional and "?" or "") end

--- The rows of the parameters of a function. A table parameter is replaced by its fields.
local function function_rows(block)
  local rows = {}
  for _, param in ipairs(block.params) do
    local class = is_given(param.type) and find_class(param.type)
    if param.name ~= "self" and not class then rows[#rows + 1] = row_of(param) end
    if class then
      if #block.params > 1 then rows[#rows + 1] = { name_of(param), "a table:" } end
      class_rows(class, rows)
    end
  end
  for _, text in ipairs(block.returns) do
    rows[#rows + 1] = { "returns", text == "T" and "its own type" or plain(text) }
  end
  return rows
end

local function signature(block)
  local names = {}
  for _, param in ipairs(block.params) do
    if param.name ~= "self" then names[#names + 1] = name_of(param) end
  end
  local name = block.is_method or block.owner == "celspan" and block.name or plain(block.name)
  return ("%s(%s)"):format(name, table.concat(names, ", "))
end

--- Adds the description of `block`, a function, a class or another name; `blocks`: all of them.
local function add_block(page, blocks, block)
  if #page > 0 then page[#page + 1] = "" end
  page[#page + 1] = block.is_function and signature(block) or plain(block.name)
  if block.overload then
    page[#page + 1] = page[#page]:match "^[%w_.:]+" .. plain(block.overload:gsub("^fun", "", 1))
  end
  if #block.about > 0 then add_wrapped(page, "  ", table.concat(block.about, " "), "  ") end
  add_rows(page, block.is_function and function_rows(block) or class_rows(block, {}))
  for _, other in ipairs(blocks) do
    local is_method = block.class and other.owner == block.class
    if is_method then page[#page + 1] = "  " .. signature(other) end
  end
end

local function module_page(name, blocks)
  local page = { ('local %s = require "celspan.%s"'):format(name, name), "" }
  for _, line in ipairs(blocks[1].about) do page[#page + 1] = line ~= "" and "  " .. line or "" end
  for i = 2, #blocks do
    if not is_given(blocks[i].name) then add_block(page, blocks, blocks[i]) end
  end
  return table.concat(page, "\n") .. "\n"
end

--- Whether a name means a block: stroke, celspan.stroke, object:stroke, motion.along.
local function is_meant(block, name)
  return block.name == name or block.name == "celspan." .. name or block.is_method == name
    or block.is_method and block.short == name
end

local function add_meant(page, blocks, name)
  local is_function = false
  for _, block in ipairs(blocks) do
    is_function = is_function or block.is_function and not block.is_method and is_meant(block, name)
  end
  for _, block in ipairs(blocks) do
    if is_meant(block, name) and not (block.class and is_function) then
      add_block(page, blocks, block)
    end
  end
end

--- Every name that has a page.
local function names_of(all)
  local names, is_known = {}, {}
  local function add(name)
    if name and not is_known[name] then names[#names + 1] = name end
    is_known[name or ""] = true
  end
  local function add_all(blocks)
    for _, block in ipairs(blocks) do
      add(block.name and plain(block.name))
      add(block.is_method and block.short)
    end
  end
  add_all(all)
  for _, module in ipairs(manual.MODULES) do
    add(module)
    add_all(all.modules[module])
  end
  table.sort(names)
  return names
end

--- The first sentence of a block.
local function first_sentence(block)
  return (table.concat(block.about, " ") .. " "):match "^(.-%.) " or ""
end

--- The functions, the methods and the modules: a list of { name, its first sentence }.
---@return string[][]
function manual.names()
  local all, list = blocks_of_all(), {}
  local function add(name, block) list[#list + 1] = { name, first_sentence(block) } end
  for _, block in ipairs(all) do
    local name = block.is_method or block.owner == "celspan" and block.short
    if name then add(name, block) end
  end
  for _, module in ipairs(manual.MODULES) do
    local blocks = all.modules[module]
    add(module, blocks[1])
    for _, block in ipairs(blocks) do
      if block.is_function then add(plain(block.name), block) end
    end
  end
  return list
end

--- The names of the module celspan and of its modules, with a sentence about each function.
function manual.list()
  local all, rows, methods, types, is_function = blocks_of_all(), {}, {}, {}, {}
  for _, block in ipairs(all) do is_function[block.name or ""] = block.is_function end
  for _, block in ipairs(all) do
    if block.owner == "celspan" then
      rows[#rows + 1] = { block.short, first_sentence(block) }
    elseif block.is_method then
      methods[#methods + 1] = block.is_method
    elseif block.name and block.name:find "^celspan%.[%l_]+$" and not is_function[block.name] then
      types[#types + 1] = plain(block.name)
    end
  end
  local page = { "celspan help lua NAME says more about a name; a ? marks what may be left out.",
                 "\nFunctions of celspan:" }
  add_rows(page, rows)
  page[#page + 1] = "\nMethods:"
  add_wrapped(page, "  ", table.concat(methods, ", "), "  ")
  page[#page + 1] = "\nTypes:"
  add_wrapped(page, "  ", table.concat(types, ", "), "  ")
  page[#page + 1] = '\nModules, local NAME = require "celspan.NAME":'
  rows = {}
  for _, name in ipairs(manual.MODULES) do
    rows[#rows + 1] = { name, first_sentence(all.modules[name][1]) }
  end
  add_rows(page, rows)
  page[#page + 1] = "\ncelspan help lua annotations prints the annotations for the Lua language "
    .. "server."
  return table.concat(page, "\n") .. "\n"
end

-- ---------------------------------------------------------------- tables

--- A field of a noun for other programs. Missing facts are unknown, or there is no limit.
local function fact_of_field(field)
  local preset = tonumber(field.preset) or field.preset or field.fallback
  return { name = field.name, type = field.type, about = field.about, default = preset,
           required = field.is_required or false, least = field.least, above = field.above,
           most = field.most }
end

--- A function, or a table that a function takes or returns.
local function fact_of_block(block, module)
  local function items(list)
    local facts = {}
    for i, item in ipairs(list) do
      facts[i] = { name = item.name, type = item.type, about = item.comment,
                   required = not item.is_optional }
    end
    return { list = facts }
  end
  local fact = { name = block.name, about = table.concat(block.about, " "), module = module }
  if block.is_function then
    fact.parameters, fact.returns = items(block.params), { list = block.returns }
  else
    fact.fields, fact.extends = items(block.fields), block.parents ~= "" and block.parents or nil
  end
  return fact
end

--- The interface as tables: `nouns` with the fields of their constructors, `functions` (methods
--- too) and `types`; and `modules` with a sentence about each.
function manual.facts()
  local all, facts = blocks_of_all(), { nouns = {}, functions = {}, types = {}, modules = {} }
  local is_noun = {}
  for _, noun in pairs(native.nouns()) do
    local fields = {}
    for i, field in ipairs(noun) do fields[i] = fact_of_field(field) end
    local class = noun.table or ("celspan.%s.fields"):format(noun.name)
    is_noun[class] = true
    table.insert(facts.nouns, { name = noun.name, about = noun.about, class = class,
                                items = noun.item, fields = { list = fields } })
  end
  local function add(blocks, module)
    for _, block in ipairs(blocks) do
      if block.name and not is_noun[block.name] then
        table.insert(block.is_function and facts.functions or facts.types,
          fact_of_block(block, module))
      end
    end
  end
  add(all, "celspan")
  for _, name in ipairs(manual.MODULES) do
    local blocks = all.modules[name]
    table.insert(facts.modules, { name = "celspan." .. name, about = first_sentence(blocks[1]) })
    add(blocks, "celspan." .. name)
  end
  for name, list in pairs(facts) do
    if name ~= "modules" then table.sort(list, function(a, b) return a.name < b.name end) end
    facts[name] = { list = list }
  end
  return facts
end

-- ---------------------------------------------------------------- one name

--- The page about a name; without a name, the list; nil and a message for an unknown name.
---@param name? string
---@return string? page
---@return string? message
function manual.page(name)
  if not name then return manual.list() end
  if name == "annotations" then return manual.annotations() end
  local all, page = blocks_of_all(), {}
  local module = all.modules[name:gsub("^celspan%.", "")]
  if module then return module_page(name:gsub("^celspan%.", ""), module) end
  add_meant(page, all, name)
  for _, other in ipairs(manual.MODULES) do add_meant(page, all.modules[other], name) end
  if #page > 0 then return table.concat(page, "\n") .. "\n" end
  local nearest = native.nearest(name, names_of(all))
  return nil, ("there is no page about '%s'%s"):format(name,
    nearest and ("; did you mean '%s'?"):format(nearest) or "; celspan help lua lists the names")
end

return manual
