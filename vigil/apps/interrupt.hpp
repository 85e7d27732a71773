#pragma once

namespace vigil::apps {

/// Lets Ctrl-C and SIGTERM be noticed instead of ending the program at once; a second one ends it as usual. A limit on
/// the size of files becomes an error of writing.
void catch_interrupts();
[[nodiscard]] bool is_interrupted() noexcept;

}  // namespace vigil::apps
