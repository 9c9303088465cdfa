# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What docs/recipes.md shows of examples/recipes: the lines between `// recipe`
# and `// end of recipe`, or those of them between `// shown` and `// end of shown`.
module Recipes
  FOLDER = 'examples/recipes'
  MARKED = %r{^// recipe\n(.*?)^// end of recipe\n}m.freeze
  SHOWN = %r{^// shown\n(.*?)^// end of shown\n}m.freeze

  PLANT = 'extern int16_t measure(void); extern void drive(int16_t);'

  # What a recipe takes for granted, for the compiler that CodeBlocks calls.
  GIVEN = {
    'interrupt' => 'extern void disable_interrupts(void); extern void enable_interrupts(void);  ' \
                   "#{PLANT}",
    'guard' => 'extern void cut_supply(void); extern void close_supply(void);',
    'freertos' => 'typedef uint32_t TickType_t; typedef long BaseType_t; typedef void *QueueHandle_t; enum { pdTRUE = 1 }; ' \
                  'extern BaseType_t xQueueOverwrite(QueueHandle_t, const void *); ' \
                  'extern BaseType_t xQueueReceive(QueueHandle_t, void *, TickType_t); ' \
                  'extern TickType_t pdMS_TO_TICKS(TickType_t); extern TickType_t xTaskGetTickCount(void); ' \
                  'extern void vTaskDelayUntil(TickType_t *, TickType_t); ' \
                  "#{PLANT}",
    'zephyr' => "\n#include <stddef.h>\n" \
                "#define K_MSGQ_DEFINE(name, bytes, messages, align) static struct k_msgq name\n" \
                "#define K_TIMER_DEFINE(name, expiry, stop) static struct k_timer name\n" \
                'struct k_msgq { int any; }; struct k_timer { int any; }; enum { K_NO_WAIT }; extern int K_MSEC(int); ' \
                'extern void k_timer_start(struct k_timer *, int, int); extern uint32_t k_timer_status_sync(struct k_timer *); ' \
                'extern int k_msgq_put(struct k_msgq *, const void *, int); extern int k_msgq_get(struct k_msgq *, void *, int); ' \
                "#{PLANT}"
  }.freeze

  class << self
    def names
      Dir["#{FOLDER}/*.c"].map { |path| File.basename(path, '.c') }.sort
    end

    # All of it, without marks.
    def whole(name)
      marked(name).gsub(%r{^// (?:end of )?shown\n}, '')
    end

    def part(name)
      shown = marked(name)[SHOWN, 1] or return "```c\n#{whole(name)}```\n"

      "```c\n#{shown}```\n\n[The whole program](../#{FOLDER}/#{name}.c)\n"
    end

    # What a document does not show: recipes, and in its table its sections.
    def missing(text)
      names.reject { |name| text.include?("<!-- recipe #{name}:begin -->") } + unlinked(text)
    end

    private

    # The sections that its first table does not lead to.
    def unlinked(text)
      anchors = text.scan(/^## (.*)/).flatten.map { |title| "##{title.downcase.delete('^a-z0-9 -').tr(' ', '-')}" }
      anchors.reject { |anchor| text[/^\| you want.*?\n\n/m].include?("(#{anchor})") }
    end

    def marked(name)
      path = "#{FOLDER}/#{name}.c"
      File.read(path)[MARKED, 1] or abort "#{path} marks no recipe"
    end
  end
end
