// The images in flash. The assembler finds them in the folder that the build names.
asm(R"(
  .section .device_image, "a"
  .balign 64
  .incbin "device.tactus"
  .section .scene_image, "a"
  .balign 64
  .incbin "scene.tactus"
  .text
)");
