--- The page of a run as it grows: lines of Markdown, and plots drawn by celspan.
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"

local Page = {}
Page.__index = Page

--- folder: that of the run; celspan: the program that draws; docs: where the page will be.
function Page.new(folder, celspan, docs)
  return setmetatable({ folder = folder, celspan = celspan, docs = docs, out = {},
                        run = results.read(folder .. "/bench.csv") }, Page)
end

function Page:put(...) self.out[#self.out + 1] = table.concat { ... } end

function Page:cells(list) self:put("| ", table.concat(list, " | "), " |") end

--- The names of the columns of a table.
function Page:head(list)
  self:cells(list)
  self:put("|", ("---|"):rep(#list))
end

--- A plot of scripts/plot.lua.
function Page:plot(name, ...)
  local file = ("%s/pictures/bench-%s.png"):format(self.docs, name)
  assert(os.execute("CELSPAN_PATH='./?.lua' " .. Runner.command(self.celspan, "render",
    "tests/bench/scripts/plot.lua", "--trust", "--progress", "none", "-o", file, "--",
    self.folder .. "/bench.csv", ...)))
  if self.out[#self.out] ~= "" then self:put "" end
  self:put("![](pictures/bench-", name, ".png)")
  self:put ""
end

function Page:write(path)
  local file = assert(io.open(path, "w"))
  file:write(table.concat(self.out, "\n"), "\n")
  assert(file:close())
end

return Page
