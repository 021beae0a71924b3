# Filled by shaders/: build-time SPIR-V, see mote_shader() there.
