#!/bin/sh
# USB: the contract and every error of UsbEndpoint through libusb, the Falcon's and the Haply board's drivers at 1 kHz, all
# against gadgets behind a dummy host controller at full speed.
modprobe dummy_hcd is_high_speed=0
modprobe -a libcomposite usb_f_fs usb_f_acm cdc-acm

# One test looks at a device as a user without rights, who must see this file system all the same.
chmod 755 /

# Hot-plug events need a daemon that passes them on.
/usr/lib/systemd/systemd-udevd --daemon
udevadm trigger --action=add
udevadm settle

# gadget NAME VENDOR PRODUCT FUNCTION: unplugged at first; the tests plug it in.
gadget() {
  folder="/sys/kernel/config/usb_gadget/$1"
  mkdir -p "$folder/strings/0x409" "$folder/configs/c.1" "$folder/functions/$4"
  echo "$2" >"$folder/idVendor"
  echo "$3" >"$folder/idProduct"
  echo "$1-1" >"$folder/strings/0x409/serialnumber"
  ln -s "$folder/functions/$4" "$folder/configs/c.1"
}
gadget echo 0x1D6B 0x0104 ffs.echo
gadget falcon 0x0403 0xCB48 ffs.falcon
gadget haply 0x2341 0x804D acm.haply
for name in echo falcon; do
  mkdir -p "/dev/ffs/$name"
  mount -t functionfs "$name" "/dev/ffs/$name"
done

# Controller and devices above the rest of the machine, as they would run.
exec chrt -f 20 usb_rig_tests --gtest_brief=1
