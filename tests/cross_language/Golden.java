// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Golden GOLDEN_FOLDER OUT_FOLDER: decodes every golden message by lcm-gen's code, writes its values as JSON and encodes it again.
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.DataInput;
import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.File;
import java.lang.reflect.Array;
import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.StringJoiner;
import lcm.lcm.LCMEncodable;

public class Golden {
    static String json(Object value) throws Exception {
        if (value instanceof String) {
            // LCM's Java code makes a character of every byte.
            String text = new String(((String) value).getBytes(StandardCharsets.ISO_8859_1), StandardCharsets.UTF_8);
            return '"' + text.replace("\\", "\\\\").replace("\"", "\\\"") + '"';
        }
        if (value.getClass().isArray()) {
            StringJoiner parts = new StringJoiner(",", "[", "]");
            for (int i = 0; i < Array.getLength(value); ++i) {
                Object part = Array.get(value, i);
                parts.add(part instanceof Byte ? String.valueOf((Byte) part & 0xff) : json(part));
            }
            return parts.toString();
        }
        if (!(value instanceof LCMEncodable)) return value.toString();
        StringJoiner members = new StringJoiner(",", "{", "}");
        for (Field field : value.getClass().getFields()) {
            if (Modifier.isStatic(field.getModifiers())) continue;
            members.add('"' + field.getName() + "\":" + json(field.get(value)));
        }
        return members.toString();
    }

    public static void main(String[] args) throws Exception {
        for (File file : new File(args[0]).listFiles((folder, name) -> name.endsWith("_t.bin"))) {
            String name = file.getName().replace(".bin", "");
            byte[] data = Files.readAllBytes(file.toPath());
            DataInput in = new DataInputStream(new ByteArrayInputStream(data));
            Object message = Class.forName("graspd." + name).getConstructor(DataInput.class).newInstance(in);
            Files.writeString(Path.of(args[1], name + ".json"), json(message));
            ByteArrayOutputStream out = new ByteArrayOutputStream();
            ((LCMEncodable) message).encode(new DataOutputStream(out));
            Files.write(Path.of(args[1], name + ".bin"), out.toByteArray());
        }
    }
}
