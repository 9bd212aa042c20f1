import java.io.DataInputStream;
import java.nio.file.*;

/** Decodes each file named by the class that lcm-spy finds for it in its class path, and prints the class's name. */
public class Decode {
    public static void main(String[] files) throws Exception {
        lcm.spy.LCMTypeDatabase types = new lcm.spy.LCMTypeDatabase();
        for (String file : files) {
            byte[] message = Files.readAllBytes(Path.of(file));
            long fingerprint = java.nio.ByteBuffer.wrap(message).getLong();
            Class<?> type = types.getClassByFingerprint(fingerprint);
            type.getConstructor(byte[].class).newInstance((Object) message);
            System.out.println(type.getName());
        }
    }
}
