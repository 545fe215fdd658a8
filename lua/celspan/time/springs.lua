--- How a mass on a spring follows the end of the spring, as a function of time.
--
--     1 |      .-.                     The response is the share of its way that the mass has gone
--       |     /   `-._.-------         some time after the end was moved. A movement is many small
--       |    /                         steps, so where the mass is now is a sum over the moments
--     0 |___/________________ time     before: each has the weight by which the response grew.
local fields = require "celspan.fields"

local springs = {}

local pi, sin, cos, exp = math.pi, math.sin, math.cos, math.exp

--- Refuses a number of swings per second, in the field `name`, or a damping that no spring has.
function springs.check(noun, name, frequency, damping)
  fields.must(frequency > 0, ("%s: field '%s'"):format(noun, name), "more than 0", frequency)
  fields.must(damping >= 0.05 and damping <= 1, noun .. ": field 'damping'", "0.05 to 1", damping)
end

--- The share of its way that the mass has gone, by the time after its end was moved.
function springs.response(frequency, damping)
  local rate = 2 * pi * frequency
  if damping < 1 then
    local swing = rate * math.sqrt(1 - damping * damping)
    return function(time)
      return 1 - exp(-damping * rate * time)
        * (cos(swing * time) + damping * rate / swing * sin(swing * time))
    end
  end
  return function(time) return 1 - exp(-rate * time) * (1 + rate * time) end
end

--- The seconds after which only a share `left` of a movement remains.
function springs.window(frequency, damping, left)
  return -math.log(left) / (2 * pi * frequency * damping) * (damping == 1 and 1.4 or 1)
end

--- The weights of `count` moments: the middles of equal parts of the window, the newest first.
--- Their sum is 1.
function springs.weights(response, window, count)
  local weights, total = {}, response(window)
  for i = 1, count do
    weights[i] = (response(window * i / count) - response(window * (i - 1) / count)) / total
  end
  return weights
end

return fields.seal("springs", springs)
