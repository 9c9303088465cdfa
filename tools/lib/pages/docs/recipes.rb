# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What docs/recipes.md shows of examples/recipes: the lines between `// recipe`
# and `// end of recipe`.
module Recipes
  FOLDER = 'examples/recipes'
  MARKED = %r{^// recipe\n(.*?)^// end of recipe\n}m.freeze

  # What a recipe takes for granted, for the compiler of the document's blocks.
  GIVEN = {
    'interrupt' => 'extern void disable_interrupts(void); extern void enable_interrupts(void); ' \
                   'extern int16_t measure(void); extern void drive(int16_t);'
  }.freeze

  class << self
    def names
      Dir["#{FOLDER}/*.c"].map { |path| File.basename(path, '.c') }.sort
    end

    def part(name)
      path = "#{FOLDER}/#{name}.c"
      code = File.read(path)[MARKED, 1] or abort "#{path} marks no recipe"
      given = GIVEN[name] ? "<!-- given: #{GIVEN[name]} -->\n" : ''
      "#{given}```c\n#{code}```\n"
    end

    # The recipes that a document does not show.
    def missing(text)
      names.reject { |name| text.include?("<!-- recipe #{name}:begin -->") }
    end
  end
end
